#include "app/steps/depth/touch_probe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/steps/depth/depth_step.h"
#include "simulation/core/units.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::app {
namespace {

constexpr double kTick = 1e-3;      // s
constexpr double kApproach = 3e-3;  // m, free way in front of the surface
constexpr int kApproachTicks = 60;
constexpr double kSearch = 5e-3;  // m, behind the relief
constexpr double kStep = 5e-5;    // m per tick
constexpr int kPressTicks = 60;
constexpr double kReached = 3e-3;  // m, of the tip from the point before it presses

}  // namespace

TouchProbe::TouchProbe(const LoadedScene& scene, const simulation::SessionOptions& options)
    : session_(scene, options),
      rig_(scene.scene.rig.instrument),
      portal_(scene.scene.portals.incision_spacing, 0, 0) {
  // The ramp after arming, and the rise of the whole force.
  const simulation::LimiterOptions& limiter = options.limiter;
  settled_ = static_cast<int>(
      std::ceil((limiter.ramp_time + limiter.max_force / limiter.max_rise) / kTick));
}

void TouchProbe::Lead(const glm::dvec3& tip, int ticks) {
  const glm::dvec3 from = tip_;
  for (int i = 1; i <= ticks; ++i) {
    tip_ = glm::mix(from, tip, static_cast<double>(i) / ticks);
    const glm::dvec3 way = tip_ - portal_;
    const double depth = glm::length(way);
    const glm::dvec3 axis = depth > 0 ? way / depth : glm::dvec3(0, 0, 1);
    simulation::RodPose pose;
    pose.depth = depth;
    pose.latitude = -std::asin(std::clamp(axis.y, -1.0, 1.0));
    pose.longitude = std::atan2(axis.x, axis.z);
    simulation::DeviceSample sample;
    sample.t = t_ += kTick;
    sample.hip_in_device = simulation::HipFromRodPose(pose, rig_);
    sample.handle_in_device = simulation::HandleFromRodPose(pose, rig_);
    sample.valid = true;
    session_.Tick({}, sample, kTick);
  }
}

TouchReading TouchProbe::Press(const glm::dvec3& point, double press) {
  TouchReading reading;
  reading.point = point;
  reading.range = glm::length(point);
  const glm::dvec3 inwards = point / reading.range;
  // The instrument enters anew, through its portal.
  session_.Tick({}, {}, kTick);
  const glm::dvec3 before = point - kApproach * inwards;
  tip_ = portal_ + 1e-3 * glm::normalize(before - portal_);
  Lead(tip_, settled_);  // armed in free space
  Lead(before, kApproachTicks);
  const simulation::ToolState& tool = session_.snapshot().instrument;
  reading.is_reached = glm::distance(tool.proxy_in_portal, before) < kReached;
  // The felt surface is smoothed, so it lies a little before or behind the relief.
  double depth = -kApproach;
  while (tool.contact < 0 && depth < kSearch) Lead(point + (depth += kStep) * inwards, 1);
  Lead(point + (depth + press) * inwards, kPressTicks);
  Lead(point + (depth + press) * inwards, settled_);
  reading.tip_force = glm::length(tool.tip_force);
  reading.force = glm::length(tool.hand_force);
  if (reading.tip_force > 0) {
    reading.normal = tool.tip_force / reading.tip_force;
    const double given = glm::dot(tool.proxy_in_portal - tool.tip_in_portal, reading.normal);
    reading.stiffness = given > 0 ? reading.tip_force / given : 0.0;
  }
  return reading;
}

void ToggleTouch(EditorState& state) {
  TouchPreview& touch = state.steps.depth->touch;
  // From another page it is switched on, whatever it was there.
  touch.is_on = state.step != Step::kDepth || !touch.is_on;
  state.step = Step::kDepth;
  touch.reading.reset();
  if (touch.is_on && state.steps.depth->board.tool == MapTool::kBrush) LeaveDepthBrush(state);
  if (!touch.is_on) touch = {};
}

bool TouchesRelief(const EditorState& state) {
  return state.step == Step::kDepth && state.steps.depth->touch.is_on && state.document().depth &&
         !state.practice && !state.practice_only;
}

void KeepTouchFresh(EditorState& state, const simulation::SessionOptions& options) {
  TouchPreview& touch = state.steps.depth->touch;
  const auto& depth = state.document().depth;
  if (!TouchesRelief(state) || touch.depth == depth || state.jobs.busy() || DepthIsUnderWay(state))
    return;
  touch.depth = depth;
  touch.probe.reset();
  state.jobs.Start("Touch preview",
                   [document = state.document(), options](const Progress&) -> Jobs::Apply {
                     auto probe = std::make_shared<TouchProbe>(document, options);
                     return [probe, depth = document.depth](EditorState& now) {
                       if (now.steps.depth->touch.depth == depth)
                         now.steps.depth->touch.probe = probe;
                     };
                   });
}

void TouchAlong(EditorState& state, const authoring::Sight& sight) {
  TouchPreview& touch = state.steps.depth->touch;
  touch.reading.reset();
  if (!touch.probe) return;
  if (const auto point = authoring::PointOnRelief(state.document(), sight))
    touch.reading = touch.probe->Press(point->x_in_portal, touch.press);
}

std::string WordsOfTouch(const TouchReading& reading) {
  std::string words = fmt::format("{:.1f} mm from the portal", MmFromMetres(reading.range));
  if (!(reading.tip_force > 0)) return words + "; the probe feels nothing here";
  // Tilt of the surface against the line from the portal.
  const double cosine =
      std::clamp(-glm::dot(reading.normal, glm::normalize(reading.point)), -1.0, 1.0);
  words +=
      fmt::format("; normal tilted by {:.0f}°; {:.2f} N/mm; {:.2f} N on the hand",
                  DegreesFromRadians(std::acos(cosine)), 1e-3 * reading.stiffness, reading.force);
  return reading.is_reached ? words : words + "; the rod meets something on its way";
}

}  // namespace arthro::app
