// Material of the chosen tissue: a preset by name, and the values that the author changed.
#pragma once

#include <optional>
#include <string>

#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

// Fills state.tissue_presets from state.steps.tissue->preset_folder, once. A fault becomes a
// dialog.
void LoadTissuePresets(EditorState& state);

// The tissue's preset with its own values; nothing where its word is not known.
std::optional<simulation::TissuePreset> PresetOf(const EditorState& state, const Tissue& tissue);

// Another preset; what was said otherwise goes.
void ChoosePreset(EditorState& state, int tissue, const std::string& name);
// The same preset, other values. One that is the preset's own is not kept as said otherwise.
void SetElasticity(EditorState& state, int tissue, Elasticity elasticity, const std::string& what);

// A solid that does not give way is touched as a function; it has no tetrahedra, so those that it
// has are left out with the same step.
void SetSolid(EditorState& state, int tissue, bool is_solid);

}  // namespace arthro::app
