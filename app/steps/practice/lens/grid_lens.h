// Lens of the rig's scope from pictures of a grid: chosen, calibrated beside the window, judged,
// then written into a file and taken for the scene.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "app/state/editor_state.h"

namespace arthro::authoring {
struct PicturesLens;
}

namespace arthro::app {

struct Command;
struct Ui;

struct GridLens {
  double spacing = 1e-3;  // m, step of the target
  std::vector<std::filesystem::path> pictures;
  std::shared_ptr<const authoring::PicturesLens> found;  // result of the last pictures, or null
};

// Asks for a folder of pictures, or for one picture, and calibrates.
void BrowseForGrid(EditorState& state);
// `place`: a folder, all pictures of which are taken, or one picture. Throws Error.
void LensFromGrid(EditorState& state, const std::filesystem::path& place);
// True where the last pictures gave a lens.
bool HasGridLens(const EditorState& state);
void SaveGridLens(EditorState& state);  // asks for the file
void UseGridLens(EditorState& state);   // becomes the lens of the scene's scope

std::span<const Command> GridLensCommands();
void GridLensFields(Ui& ui, EditorState& state);

}  // namespace arthro::app
