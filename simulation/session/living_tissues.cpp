#include "simulation/session/living_tissues.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/mesh_io.h"

namespace arthro::simulation {
namespace {

BodySpec BodyOf(const Tissue& tissue, int index, const SurfaceMesh& surface, TetMesh mesh,
                const TissuePreset& preset) {
  BodySpec body;
  body.name = tissue.name;
  body.tissue = index;
  body.mesh = std::move(mesh);
  body.surface = surface;
  body.material = WithElasticity(preset, tissue.elasticity).material;
  body.fixed = tissue.fixed;
  body.portal_from_body = {tissue.pose.quaternion, tissue.pose.position};
  body.is_cuttable = tissue.is_cuttable;

  const double scale = tissue.pose.scale;
  for (glm::dvec3& x : body.mesh.rest_positions) x *= scale;
  for (glm::dvec3& x : body.surface.vertices) x *= scale;
  for (Ball& ball : body.fixed) {
    ball.centre *= scale;
    ball.radius *= scale;
  }
  return body;
}

}  // namespace

std::vector<BodySpec> LivingTissues(const Scene& scene, std::span<const SurfaceMesh> surfaces,
                                    const FileOf& file_of, const std::vector<TissuePreset>& presets,
                                    std::vector<std::string>* messages) {
  std::vector<BodySpec> bodies;
  const std::size_t count = std::min(surfaces.size(), scene.tissues.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Tissue& tissue = scene.tissues[i];
    if (tissue.mesh.empty() || surfaces[i].triangles.empty()) continue;
    const TissuePreset* preset = FindTissuePreset(presets, tissue.material);
    if (preset == nullptr)
      throw Error(Code::kBadScene,
                  fmt::format("{}: there is no tissue preset \"{}\"; choose another material",
                              tissue.name, tissue.material));
    TetReadReport report;
    TetMesh mesh = ReadTetMesh(file_of(tissue.mesh), &report);
    if (messages != nullptr)
      for (const std::string& message : report.messages)
        messages->push_back(tissue.name + ": " + message);
    bodies.push_back(BodyOf(tissue, static_cast<int>(i), surfaces[i], std::move(mesh), *preset));
  }
  return bodies;
}

}  // namespace arthro::simulation
