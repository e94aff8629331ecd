// Import of a depth map that another program made: the file is read first, then its author says
// what its numbers mean.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/state/editor_state.h"
#include "authoring/depth/depth_import.h"

namespace arthro::app {

// A file that was read and waits for its meaning.
struct DepthImport {
  std::filesystem::path file;
  std::shared_ptr<const authoring::GreyNumbers> numbers;
  authoring::DepthImportOptions options;
};

// Reads the file in a job; then the Depth page asks for unit and range.
void ChooseDepthImport(EditorState& state, const std::filesystem::path& file);
// Ranges that the file has with its options, "30.0 to 50.0 mm from the portal", or the fault.
std::string WordsOfImport(const EditorState& state);
// Puts the map in place of the present one, in one step that is undone. Throws Error.
void TakeDepthImport(EditorState& state);

}  // namespace arthro::app
