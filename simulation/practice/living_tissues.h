// Specifications of the deformable tissues of a scene, from their presets and the values that the
// scene overrides. The frame of a body is that of its tissue with the scale applied.
#pragma once

#include <string>
#include <vector>

#include "simulation/practice/session.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/implicit_body.h"
#include "simulation/tissue/body/layer_skin.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::simulation {

// Surface, balls, cuts and regions of a tissue in the frame of its body.
struct BodyPlaces {
  SurfaceMesh surface;
  std::vector<Ball> fixed;
  std::vector<Cut> cuts;
  std::vector<Region> regions;
};
BodyPlaces PlacesOf(const Tissue& tissue, const SurfaceMesh& surface);

// Tissues with tetrahedra. Appends one sentence to `messages` per repair that reading a mesh made.
// Throws Error for a mesh that cannot be read or does not fill its surface, and for a preset that
// does not exist.
std::vector<BodySpec> LivingTissues(const LoadedScene& loaded,
                                    const std::vector<TissuePreset>& presets,
                                    std::vector<std::string>* messages = nullptr);

// Tissues that give way as thin layers: those without tetrahedra whose preset is thin, with the
// scene's own elasticity. Throws Error for values that no layer can have.
std::vector<LayerSpec> LayersOf(const LoadedScene& loaded,
                                const std::vector<TissuePreset>& presets);

// Makes the tissues with tetrahedra and the thin layers of `loaded` live in its `session`.
void EnlivenTissues(Session& session, const LoadedScene& loaded,
                    const std::vector<TissuePreset>& presets, TissuePace pace,
                    std::vector<std::string>* messages = nullptr);

// Tissues without tetrahedra that the scene calls implicit.
std::vector<ImplicitSpec> ImplicitOf(const LoadedScene& loaded);

}  // namespace arthro::simulation
