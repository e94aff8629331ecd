#include "app/view/live_tissues.h"

#include <utility>

namespace arthro::app {
namespace {

// A body's own frame is its tissue's after the scale of the pose; the frame of the views is before
// it.
std::span<const glm::dvec3> Unscaled(std::span<const glm::dvec3> x, double scale,
                                     std::vector<glm::dvec3>& room) {
  if (scale == 1.0) return x;
  room.assign(x.begin(), x.end());
  for (glm::dvec3& p : room) p /= scale;
  return room;
}

}  // namespace

bool LiveTissues::Show(const simulation::WorldPicture& world, std::span<const Tissue> tissues,
                       ArthroscopicView& scope, Overview* overview) {
  bool changed = false;
  shown_.resize(world.bodies.size());
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const simulation::BodyPicture& body = world.bodies[i];
    Shown& shown = shown_[i];
    if (body.skin == nullptr || (shown.skin == body.skin && shown.shape == body.shape)) continue;
    const double scale = tissues[static_cast<std::size_t>(body.tissue)].pose.scale;

    // The scene's own surface is there already; any other one comes from a cut or its undoing.
    const bool is_other =
        shown.skin != body.skin && (shown.skin != nullptr || !body.skin->is_fresh.empty());
    if (is_other) {
      const auto vertices = Unscaled(body.skin->surface.vertices, scale, unscaled_);
      const SurfaceMesh surface{{vertices.begin(), vertices.end()}, body.skin->surface.triangles};
      scope.SetTissueSurface(body.tissue, surface, body.skin->is_fresh);
      if (overview != nullptr)
        overview->SetTissueSurface(body.tissue, surface, body.skin->is_fresh);
    }
    shown = {body.skin, body.shape};
    const std::span<const glm::dvec3> positions = Unscaled(body.positions, scale, unscaled_);
    const bool moved = scope.SetTissueShape(body.tissue, positions, body.normals);
    if (overview != nullptr) overview->SetTissueShape(body.tissue, positions, body.normals);
    changed = changed || moved || is_other;
  }
  return changed;
}

}  // namespace arthro::app
