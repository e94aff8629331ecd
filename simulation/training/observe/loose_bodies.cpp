#include "simulation/training/observe/loose_bodies.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/haptics/proxy.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {
namespace {

constexpr glm::dvec3 kDown(0.0, 1.0, 0.0);
// Share of the way of a sinking body below which it rests.
constexpr double kStill = 0.02;

}  // namespace

LooseBodies::LooseBodies(const LoadedScene& loaded, std::vector<LooseBody> bodies,
                         const DepthField& relief, std::vector<Ball> goals)
    : bodies_(std::move(bodies)), goals_(std::move(goals)), relief_(relief) {
  const std::size_t count = std::min(loaded.surfaces.size(), loaded.scene.tissues.size());
  for (std::size_t i = 0; i < count; ++i)
    tissues_.emplace_back(OrEmpty(loaded.surfaces[i]), loaded.scene.tissues[i].pose);
}

void LooseBodies::Sink(LooseBody& body, double dt) const noexcept {
  const double way = kSinkSpeed * dt;
  if (!(way > 0.0)) return;
  Proxy proxy;
  proxy.position = body.place;
  MoveProxy({relief_, tissues_}, body.radius, body.place + way * kDown, way, false, proxy);
  body.is_at_rest = glm::distance(proxy.position, body.place) < kStill * way;
  if (!body.is_at_rest) body.place = proxy.position;
}

void LooseBodies::Tick(const Snapshot& snapshot, double dt) noexcept {
  const ToolState& tool = snapshot.instrument;
  const bool is_grasper = snapshot.kind == ToolKind::kGrasper && tool.pose.depth > 0;
  const bool closes = is_grasper && opening_ >= kGraspOpening && tool.opening < kGraspOpening;
  opening_ = tool.opening;
  const Rigid3 portal_from_tool =
      PortalFromTool({snapshot.incision_spacing, 0.0, 0.0}, tool.proxy_in_portal, tool.pose.roll);
  if (held_ && !(is_grasper && tool.opening < kGraspOpening)) {
    LooseBody& body = bodies_[*held_];
    body.is_held = false;
    body.is_at_rest = std::ranges::any_of(goals_, [&](const Ball& goal) {
      return glm::distance(body.place, goal.centre) <= goal.radius;
    });
    held_.reset();
  }
  if (closes && !held_) {
    double nearest = kGraspReach;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double gap = glm::distance(tool.proxy_in_portal, bodies_[i].place) - bodies_[i].radius;
      if (gap > nearest) continue;
      nearest = gap;
      held_ = i;
    }
    if (held_) {
      bodies_[*held_].is_held = true;
      bodies_[*held_].is_at_rest = false;
      held_in_tool_ = Inverse(portal_from_tool) * bodies_[*held_].place;
    }
  }
  for (LooseBody& body : bodies_)
    if (!body.is_held && !body.is_at_rest) Sink(body, dt);
  if (held_) bodies_[*held_].place = portal_from_tool * held_in_tool_;
}

}  // namespace arthro::simulation
