// Lens of the scene's scope: equisolid, one of the presets of common scopes, or a file.
#pragma once

#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "app/steps/panorama/board/lens_choice.h"

namespace arthro::app {

// Equisolid first, then the presets of the folder of lenses, each with a lens that fills a round
// window.
std::vector<LensChoice> ScopeLenses(const std::filesystem::path& folder);

// Index of the choice that the scene's lens is; nothing for a lens of its own.
std::optional<int> ChosenScopeLens(const std::vector<LensChoice>& lenses, const EditorState& state);

// One sentence of the lens in use: its model, and where it comes from.
std::string WordsOfScopeLens(const EditorState& state);

// Takes a choice: the lens, its field of view, and the view angle of a preset that has one.
void ChooseScopeLens(EditorState& state, const LensChoice& choice);
// Asks for a file of `arthroscene lens`.
void BrowseForScopeLens(EditorState& state);

}  // namespace arthro::app
