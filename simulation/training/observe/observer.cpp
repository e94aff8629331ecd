#include "simulation/training/observe/observer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/surface_finder.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/disturbances.h"

namespace arthro::simulation {
namespace {

constexpr double kLeastStep = 1e-4;  // m, along a line of sight over the relief
constexpr int kMostSteps = 64;
// Points behind the tip of which two must be clear.
constexpr std::array<double, 3> kBehindTip{0, 1e-3, 2e-3};  // m
constexpr int kClearOfTip = 2;

}  // namespace

RodPose HandOf(const ToolFrame& tool) noexcept {
  const glm::dvec3 axis(tool.axis);
  return {std::asin(std::clamp(-axis.y, -1.0, 1.0)), std::atan2(axis.x, axis.z), tool.roll,
          tool.depth};
}

Observer::Observer(const LoadedScene& loaded, const std::vector<TargetPlace>& targets,
                   const DepthField& relief, const ScopeEye& eye)
    : optics_(OpticsOf(loaded.scene.scope, loaded.lens)), relief_(relief), eye_(eye) {
  if (targets.size() > static_cast<std::size_t>(kMostTargets))
    throw Error(Code::kBadArgument, fmt::format("an exercise has {} targets; at most {} are seen",
                                                targets.size(), kMostTargets));
  for (const Tissue& tissue : loaded.scene.tissues)
    portal_from_body_.push_back({tissue.pose.quaternion, tissue.pose.position});
  for (const TargetPlace& place : targets) {
    Target& target = targets_.emplace_back();
    target.place = place;
    if (place.is_loose) target.place.normal = glm::dvec3(0.0);  // a ball has none
    target.now = place.point;
    target.normal = target.place.normal;
    if (place.tissue < 0) continue;
    const Rigid3& portal_from_body = portal_from_body_.at(static_cast<std::size_t>(place.tissue));
    target.now = portal_from_body * place.point;
    target.normal = portal_from_body.rotation * target.place.normal;
  }
  for (std::size_t kind = 0; kind < shapes_.size(); ++kind)
    shapes_[kind] = ShapeOf(static_cast<ToolKind>(kind));
}

void Observer::Tie(Target& target, const std::shared_ptr<const BodySkin>& skin) noexcept {
  target.skin = skin;
  target.is_gone = true;
  double nearest2 = kTiedAnewWithin * kTiedAnewWithin;
  const SurfaceMesh& surface = skin->surface;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const TriangleCorners corner = CornersOf(surface, i);
    if (Distance2(BoxOf(corner), target.place.point) > nearest2) continue;
    const glm::dvec3 at = ClosestOnTriangle(corner, target.place.point);
    const glm::dvec3 off = PointOn(corner, at) - target.place.point;
    if (glm::dot(off, off) > nearest2) continue;
    nearest2 = glm::dot(off, off);
    target.at = at;
    target.vertices = surface.triangles[i];
    target.is_gone = false;
  }
}

void Observer::Follow(const WorldPicture& world) noexcept {
  for (const BodyPicture& body : world.bodies) {
    if (body.skin == nullptr) continue;
    for (Target& target : targets_) {
      if (target.place.is_loose || target.place.tissue != body.tissue) continue;
      if (target.skin != body.skin) Tie(target, body.skin);
      if (target.is_gone) continue;
      TriangleCorners corner;
      for (std::size_t i = 0; i < 3; ++i)
        corner[i] = body.positions[static_cast<std::size_t>(target.vertices[i])];
      const Rigid3& portal_from_body = portal_from_body_[static_cast<std::size_t>(body.tissue)];
      target.now = portal_from_body * PointOn(corner, target.at);
      const glm::dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      const double area = glm::length(across);
      if (area > 0) target.normal = portal_from_body.rotation * (across / area);
    }
  }
}

bool Observer::IsHiddenByRelief(const Segment3& between) const noexcept {
  if (relief_.empty()) return false;
  const glm::dvec3 way = between.b - between.a;
  const double length = glm::length(way);
  double along = 0;
  while (along < length) {
    const glm::dvec3 x = between.a + (along / length) * way;
    const double free = relief_.free_radius() - glm::length(x);
    double step = free;
    if (!(free > kLeastStep)) {
      const FieldQuery query = relief_.Query(x);
      const bool is_known = query.weight > 0;
      if (is_known && query.clearance < 0) return true;
      step = is_known ? 0.5 * query.clearance : 0;
    }
    // The least step lets the line end within kMostSteps.
    along += std::max({step, kLeastStep, length / kMostSteps});
  }
  const FieldQuery end = relief_.Query(between.b);
  return end.weight > 0 && end.clearance < 0;
}

PointSight Observer::SightOf(const glm::dvec3& x, const glm::dvec3& normal,
                             const Look& look) const noexcept {
  PointSight sight;
  sight.place = glm::vec3(x);
  const glm::dvec3 way = x - look.lens;
  const double distance = glm::length(way);
  if (!(distance > kSurfaceMargin)) return sight;
  const glm::dvec3 direction = way / distance;
  const double centre = glm::length(PlaceOf(optics_, look.view, direction));
  sight.centre = static_cast<float>(centre);
  sight.distance = static_cast<float>(distance);
  if (normal != glm::dvec3(0.0))
    sight.incidence =
        static_cast<float>(std::acos(std::clamp(-glm::dot(normal, direction), -1.0, 1.0)));
  if (!(centre <= 1)) return sight;
  if (std::exp(-kHazeExtinction[1] * look.haze * distance) < kLeastTransmittance) return sight;
  const Segment3 between{look.lens, x - kSurfaceMargin * direction};
  const bool is_behind = std::ranges::any_of(look.instrument, [&](const Capsule& capsule) {
    return Distance2(between, Segment3{capsule.a, capsule.b}) <= capsule.radius * capsule.radius;
  });
  sight.is_clear = !is_behind && !eye_.IsHiddenByTissue(between) && !IsHiddenByRelief(between);
  return sight;
}

void Observer::Observe(AttemptFrame& frame) const noexcept {
  const Observation before = std::exchange(frame.sight, {});
  frame.sight.targets = static_cast<int>(targets_.size());
  const ToolFrame &scope = frame.tool[0], &tool = frame.tool[1];
  const RodPose hand = HandOf(scope);
  // The picture is drawn from beside the drawn tip where a tissue is in the way of the tube.
  const glm::dvec3 lens = glm::dvec3(scope.drawn_tip) + eye_.beside();
  frame.lens = glm::vec3(lens);

  std::array<Capsule, kMaxCapsules> capsules;
  ToolInput as_drawn;
  as_drawn.is_present = tool.is_inside();
  as_drawn.opening = frame.opening;
  as_drawn.portal_from_tool =
      PortalFromTool({frame.incision_spacing, 0.0, 0.0}, glm::dvec3(tool.drawn_tip), tool.roll);
  const ToolShape& shape = shapes_[static_cast<std::size_t>(frame.instrument)];
  const auto count = static_cast<std::size_t>(PosedCapsules(shape, as_drawn, capsules));
  const Look look{ViewFromPose(PoseThrough(hand, lens), frame.view_angle, frame.head_roll), lens,
                  frame.haze, std::span(capsules).first(count)};
  const bool sees = scope.is_inside() && frame.fog <= kMostFog;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = targets_[i];
    PointSight& sight = frame.sight.target[i];
    const glm::dvec3 place =
        target.place.is_loose ? glm::dvec3(before.target[i].place) : target.now;
    sight.place = glm::vec3(place);
    sight.is_gone = target.is_gone;
    if (target.is_gone || !scope.is_inside()) continue;
    sight = SightOf(place, target.normal, look);
    sight.is_clear = sight.is_clear && sees;
  }
  if (!sees || !tool.is_inside()) return;
  Look past_tool = look;  // its own end does not hide it
  past_tool.instrument = {};
  int clear = 0;
  for (const double behind : kBehindTip)
    clear += SightOf(glm::dvec3(tool.drawn_tip) - behind * glm::dvec3(tool.axis), glm::dvec3(0.0),
                     past_tool)
                 .is_clear;
  frame.sight.is_tip_visible = clear >= kClearOfTip;
}

}  // namespace arthro::simulation
