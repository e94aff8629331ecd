// Specifications of the deformable tissues of a scene, from their presets and the values that the
// scene overrides. The frame of a body is that of its tissue with the scale applied.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"
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

// Returns the file of an asset that the scene names.
using FileOf = std::function<std::filesystem::path(const std::filesystem::path& name)>;

// Bodies of the tissues with tetrahedra. `surfaces` has one entry per tissue. Repairs made while
// reading a mesh are added to `messages`, one sentence each. Throws Error for a mesh that cannot be
// read or does not fill its surface, and for an unknown preset.
std::vector<BodySpec> LivingTissues(const Scene& scene, std::span<const SurfaceMesh> surfaces,
                                    const FileOf& file_of, const std::vector<TissuePreset>& presets,
                                    std::vector<std::string>* messages = nullptr);

// Thin elastic layers: the tissues without tetrahedra whose preset is thin. Throws Error for values
// that are not those of a layer.
std::vector<LayerSpec> LayersOf(const Scene& scene, std::span<const SurfaceMesh> surfaces,
                                const std::vector<TissuePreset>& presets);

// Implicit tissues: those that the scene declares implicit and that have no tetrahedra.
std::vector<ImplicitSpec> ImplicitOf(const Scene& scene, std::span<const SurfaceMesh> surfaces);

}  // namespace arthro::simulation
