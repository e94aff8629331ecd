#include "app/view/live_tissues.h"

#include <utility>

#include "app/view/settling.h"

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
    if (body.skin == nullptr || static_cast<std::size_t>(body.tissue) >= tissues.size() ||
        (shown.skin == body.skin && shown.shape == body.shape && shown.has_settled))
      continue;
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
    const std::span<const glm::dvec3> now = Unscaled(body.positions, scale, unscaled_);
    if (shown.skin != body.skin || shown.places.size() != now.size()) {
      shown.places.assign(now.begin(), now.end());
      shown.normals.assign(body.normals.begin(), body.normals.end());
      shown.has_settled = true;
    } else {
      shown.has_settled = Settle(now, body.normals, shown.places, shown.normals);
    }
    shown.skin = body.skin;
    shown.shape = body.shape;
    const bool moved = scope.SetTissueShape(body.tissue, shown.places, shown.normals);
    if (overview != nullptr) overview->SetTissueShape(body.tissue, shown.places, shown.normals);
    changed = changed || moved || is_other;
  }
  return changed;
}

InstrumentView LiveTissues::Settled(InstrumentView tool) {
  const bool goes_on = tool_ && tool_->kind == tool.kind;
  glm::dvec3 drawn = goes_on ? tool_->proxy : tool.proxy;
  Settle(tool.proxy, drawn);
  tool.proxy = drawn;
  tool_ = tool;
  return tool;
}

}  // namespace arthro::app
