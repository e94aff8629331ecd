#include "simulation/practice/living_tissues.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro::simulation {
namespace {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
};

Bounds BoundsOf(std::span<const glm::dvec3> points) {
  Bounds bounds;
  for (const glm::dvec3& x : points) {
    bounds.low = glm::min(bounds.low, x);
    bounds.high = glm::max(bounds.high, x);
  }
  return bounds;
}

// Largest distance between the bounds of mesh and surface, as a share of the surface's diagonal. A
// mesh within its budget differs by far less, a mesh of another tissue or in another unit by more.
constexpr double kMostOff = 0.2;

void CheckFills(const TetMesh& mesh, const SurfaceMesh& surface, const std::string& name,
                const std::filesystem::path& file) {
  const Bounds of_mesh = BoundsOf(mesh.rest_positions), of_surface = BoundsOf(surface.vertices);
  const double size = glm::distance(of_surface.low, of_surface.high);
  const double off = std::max(glm::distance(of_mesh.low, of_surface.low),
                              glm::distance(of_mesh.high, of_surface.high));
  if (off > kMostOff * size)
    throw Error(Code::kBadMesh,
                fmt::format("{}: its tetrahedra and its surface of {:.3g} mm lie up to {:.3g} mm "
                            "apart; fill this surface again with `arthroscene tetrahedralize`",
                            name, 1e3 * size, 1e3 * off),
                file);
}

BodySpec BodyOf(const Tissue& tissue, int index, const SurfaceMesh& surface, TetMesh mesh,
                const TissuePreset& preset) {
  BodySpec body;
  body.name = tissue.name;
  body.tissue = index;
  body.mesh = std::move(mesh);
  BodyPlaces places = PlacesOf(tissue, surface);
  body.surface = std::move(places.surface);
  body.fixed = std::move(places.fixed);
  body.cuts = std::move(places.cuts);
  body.regions = std::move(places.regions);
  body.material = WithElasticity(preset, tissue.elasticity).material;
  body.portal_from_body = {tissue.pose.quaternion, tissue.pose.position};
  body.is_cuttable = tissue.is_cuttable;
  for (glm::dvec3& x : body.mesh.rest_positions) x *= tissue.pose.scale;
  return body;
}

// Tissues that have a surface entry.
std::size_t CountOf(const LoadedScene& loaded) {
  return std::min(loaded.surfaces.size(), loaded.scene.tissues.size());
}

}  // namespace

BodyPlaces PlacesOf(const Tissue& tissue, const SurfaceMesh& surface) {
  const double scale = tissue.pose.scale;
  BodyPlaces places;
  places.surface = surface;
  for (glm::dvec3& x : places.surface.vertices) x *= scale;
  for (const Ball& ball : tissue.fixed) places.fixed.push_back(Scaled(ball, scale));
  for (const Cut& cut : tissue.cuts) places.cuts.push_back(Scaled(cut, scale));
  for (const Region& region : tissue.regions)
    places.regions.push_back({region.name, Scaled(region.ball, scale)});
  return places;
}

std::vector<BodySpec> LivingTissues(const LoadedScene& loaded,
                                    const std::vector<TissuePreset>& presets,
                                    std::vector<std::string>* messages) {
  std::vector<BodySpec> bodies;
  for (std::size_t i = 0; i < CountOf(loaded); ++i) {
    const Tissue& tissue = loaded.scene.tissues[i];
    const SurfaceMesh& surface = OrEmpty(loaded.surfaces[i]);
    if (tissue.mesh.empty() || surface.triangles.empty()) continue;
    const TissuePreset* preset = FindTissuePreset(presets, tissue.material);
    if (preset == nullptr)
      throw NamedByScene(
          Error(Code::kBadScene,
                fmt::format("{}: there is no tissue preset \"{}\"; choose another material",
                            tissue.name, tissue.material)),
          loaded);
    TetReadReport report;
    const std::filesystem::path file = FileOf(loaded, tissue.mesh);
    try {
      TetMesh mesh = ReadTetMesh(file, &report);
      CheckFills(mesh, surface, tissue.name, file);
      bodies.push_back(BodyOf(tissue, static_cast<int>(i), surface, std::move(mesh), *preset));
    } catch (const Error& error) {
      throw NamedByScene(error, loaded);
    }
    if (messages != nullptr)
      for (const std::string& message : report.messages)
        messages->push_back(tissue.name + ": " + message);
  }
  return bodies;
}

std::vector<LayerSpec> LayersOf(const LoadedScene& loaded,
                                const std::vector<TissuePreset>& presets) {
  std::vector<LayerSpec> layers;
  for (std::size_t i = 0; i < CountOf(loaded); ++i) {
    const Tissue& tissue = loaded.scene.tissues[i];
    const SurfaceMesh& surface = OrEmpty(loaded.surfaces[i]);
    if (surface.triangles.empty() || !IsThinLayer(tissue, presets)) continue;
    const TissuePreset preset =
        WithElasticity(*FindTissuePreset(presets, tissue.material), tissue.elasticity);
    try {
      layers.push_back({tissue.name,
                        static_cast<int>(i),
                        PlacesOf(tissue, surface).surface,
                        {tissue.pose.quaternion, tissue.pose.position},
                        ElasticLayer(preset.material, preset.layer_thickness)});
    } catch (const Error& error) {
      throw Error(Code::kBadScene, fmt::format("{}: {}", tissue.name, error.what()));
    }
  }
  return layers;
}

void EnlivenTissues(Session& session, const LoadedScene& loaded,
                    const std::vector<TissuePreset>& presets, TissuePace pace,
                    std::vector<std::string>* messages) {
  session.Enliven(LivingTissues(loaded, presets, messages), pace, LayersOf(loaded, presets));
}

std::vector<ImplicitSpec> ImplicitOf(const LoadedScene& loaded) {
  std::vector<ImplicitSpec> implicit;
  for (std::size_t i = 0; i < CountOf(loaded); ++i) {
    const Tissue& tissue = loaded.scene.tissues[i];
    const SurfaceMesh& surface = OrEmpty(loaded.surfaces[i]);
    if (!tissue.is_implicit || !tissue.mesh.empty() || surface.triangles.empty()) continue;
    ImplicitSpec body;
    body.name = tissue.name;
    body.tissue = static_cast<int>(i);
    BodyPlaces places = PlacesOf(tissue, surface);
    body.surface = std::move(places.surface);
    body.fixed = std::move(places.fixed);
    body.cuts = std::move(places.cuts);
    body.regions = std::move(places.regions);
    body.portal_from_body = {tissue.pose.quaternion, tissue.pose.position};
    body.is_cuttable = tissue.is_cuttable;
    implicit.push_back(std::move(body));
  }
  return implicit;
}

}  // namespace arthro::simulation
