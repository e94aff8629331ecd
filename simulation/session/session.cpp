#include "simulation/session/session.h"

#include <limits>

#include "simulation/scope/arthroscope.h"

namespace arthro::simulation {
namespace {

glm::dvec2 PixelOrNan(const Projection& projection, const glm::dvec3& direction) noexcept {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return PixelFromDirection(projection, direction).value_or(glm::dvec2(kNan));
}

}  // namespace

Session::Session(const Scene& scene, const DepthMap&, std::span<const SurfaceMesh>,
                 const SessionOptions&)
    : projection_(scene.backdrop.projection),
      radius_(scene.backdrop.radius),
      spacing_(scene.portals.incision_spacing),
      view_angle_(scene.scope.view_angle) {
  scope_.rig = scene.rig.scope;
  scope_.rig.rod_length = scene.scope.rod_length;
  instrument_.rig = scene.rig.instrument;
}

void Session::SetIncisionSpacing(double spacing) noexcept { spacing_ = spacing; }

void Session::TickTool(Tool& tool, const DeviceSample& sample, const glm::dvec3& portal, double,
                       ToolState& state) noexcept {
  state.fault = sample.valid ? Fault::kNone : Fault::kNoSample;
  if (!sample.valid) return;
  state.pose = RodPoseFromHip(sample.hip_in_device, sample.handle_in_device, tool.rig, state.pose);
  state.tip_in_portal = portal + TipInOwnPortal(state.pose);
  state.proxy_in_portal = state.tip_in_portal;
}

void Session::Tick(const DeviceSample& scope, const DeviceSample& instrument, double dt) noexcept {
  snapshot_.t += dt;
  TickTool(scope_, scope, glm::dvec3(0.0), dt, snapshot_.scope);
  TickTool(instrument_, instrument, {spacing_, 0.0, 0.0}, dt, snapshot_.instrument);
  snapshot_.scope.pixel =
      PixelOrNan(projection_, CentreDirection(snapshot_.scope.pose, view_angle_, radius_));
  snapshot_.instrument.pixel = PixelOrNan(projection_, snapshot_.instrument.tip_in_portal);
}

}  // namespace arthro::simulation
