// Tissues from files: a surface is read in the unit that the author names, then laid into the
// scene; its tetrahedra are made beside the window.
#pragma once

#include <filesystem>
#include <string>

#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

// Asks for the file, then for its unit.
void BrowseForSurface(EditorState& state);
// Reads it and adds a tissue in the middle of the view. `unit`: m, cm, mm, um or in.
void ImportSurface(EditorState& state, const std::filesystem::path& surface,
                   const std::string& unit);
// Makes tetrahedra of the chosen tissue, beside the window.
void TetrahedraliseTissue(EditorState& state);

}  // namespace arthro::app
