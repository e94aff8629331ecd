#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

void LoadTissuePresets(EditorState& state) {
  if (!state.tissue_presets.empty() || state.steps.tissue->preset_folder.empty()) return;
  Guarded(state, "Tissue presets", [&] {
    const std::filesystem::path folder = state.steps.tissue->preset_folder;
    state.steps.tissue->preset_folder.clear();  // a fault is told once
    state.tissue_presets = simulation::ReadTissuePresets(folder);
  });
}

std::optional<simulation::TissuePreset> PresetOf(const EditorState& state, const Tissue& tissue) {
  const simulation::TissuePreset* preset =
      simulation::FindTissuePreset(state.tissue_presets, tissue.material);
  if (!preset) return std::nullopt;
  return simulation::WithElasticity(*preset, tissue.elasticity);
}

void ChoosePreset(EditorState& state, int tissue, const std::string& name) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  changed.material = name;
  changed.elasticity = {};
  SetTissue(state, tissue, changed, "Change the material of");
  EndDrag(state);
}

void SetElasticity(EditorState& state, int tissue, Elasticity elasticity, const std::string& what) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  if (const auto* preset = simulation::FindTissuePreset(state.tissue_presets, changed.material)) {
    const auto drop = [](std::optional<double>& own, double of_preset) {
      if (own == of_preset) own.reset();
    };
    drop(elasticity.young_modulus, preset->material.young_modulus);
    drop(elasticity.poisson_ratio, preset->material.poisson_ratio);
    drop(elasticity.density, preset->material.density);
    drop(elasticity.fibre_stiffness, preset->material.fibre_stiffness);
    drop(elasticity.layer_thickness, preset->layer_thickness);
  }
  changed.elasticity = elasticity;
  SetTissue(state, tissue, changed, what);
}

void SetSolid(EditorState& state, int tissue, bool is_solid) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  changed.is_implicit = is_solid;
  if (is_solid) changed.mesh.clear();
  SetTissue(state, tissue, changed, is_solid ? "Make a solid of" : "Let give way");
  EndDrag(state);
}

}  // namespace arthro::app
