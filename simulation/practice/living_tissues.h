// The tissues of a scene that deform, made ready: those with tetrahedra, with their preset and what
// the scene says otherwise. Frames: each body's own is its tissue's with the scale applied.
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

// A tissue's surface and places in the frame of its body: the scale of its pose applied.
struct BodyPlaces {
  SurfaceMesh surface;
  std::vector<Ball> fixed;
  std::vector<Cut> cuts;
  std::vector<Region> regions;
};
BodyPlaces PlacesOf(const Tissue& tissue, const SurfaceMesh& surface);

// Where the bytes of an asset lie, by the name that the scene uses.
using FileOf = std::function<std::filesystem::path(const std::filesystem::path& name)>;

// `surfaces` has one a tissue. What reading a mesh repaired goes to `messages`, a sentence each.
// Throws Error for a mesh that cannot be read or does not fill its surface and a preset that is not
// there.
std::vector<BodySpec> LivingTissues(const Scene& scene, std::span<const SurfaceMesh> surfaces,
                                    const FileOf& file_of, const std::vector<TissuePreset>& presets,
                                    std::vector<std::string>* messages = nullptr);

// The tissues that give way as thin layers: those without tetrahedra whose preset is thin, with
// what the scene says otherwise. Throws Error for values that are none of a layer.
std::vector<LayerSpec> LayersOf(const Scene& scene, std::span<const SurfaceMesh> surfaces,
                                const std::vector<TissuePreset>& presets);

// The tissues that the scene calls implicit and that have no tetrahedra.
std::vector<ImplicitSpec> ImplicitOf(const Scene& scene, std::span<const SurfaceMesh> surfaces);

}  // namespace arthro::simulation
