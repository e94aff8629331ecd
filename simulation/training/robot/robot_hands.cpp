#include "simulation/training/robot/robot_hands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kTurn = std::numbers::pi / 2;  // rad/s, largest speed of a roll
constexpr double kShortest = 0.02;              // s, of a leg
// Clearances of the shafts on the way, and the steps in which a tool is withdrawn to find one.
constexpr double kScopeClear = 2e-3, kInstrumentClear = 2e-3;  // m
constexpr double kWithdraw = 4e-3, kLift = 8e-3;               // m
constexpr double kOut = -5e-3;  // m, insertion of a tool that is out of the joint
// Way from the instrument's portal on which its shaft lies in the tissue that it came through.
constexpr double kJustInside = 8e-3;
constexpr int kSamples = 16;      // poses of a way that are tested
constexpr double kSurely = 2e-3;  // m, insertion at which every turn is free

RodPose Mix(const RodPose& a, const RodPose& b, double s) {
  const auto mix = [s](double from, double to) { return from + s * (to - from); };
  return {mix(a.latitude, b.latitude), mix(a.longitude, b.longitude), mix(a.roll, b.roll),
          mix(a.depth, b.depth)};
}

// Way of the tip between two poses.
double WayOf(const RodPose& a, const RodPose& b) {
  const double depth = std::max({a.depth, b.depth, 0.0});
  const double turn = std::acos(std::clamp(glm::dot(BasisOf(a).axis, BasisOf(b).axis), -1.0, 1.0));
  return std::hypot(b.depth - a.depth, depth * turn);
}

// The same roll, within half a turn of another one.
double NearestRoll(double roll, double to) {
  return to + std::remainder(roll - to, 2 * std::numbers::pi);
}

}  // namespace

double MinimumJerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (-15 + 6 * s));
}

RodPose PoseOfTip(const glm::dvec3& portal, const glm::dvec3& tip, double roll) {
  const glm::dvec3 rod = tip - portal;
  RodPose pose;
  pose.depth = glm::length(rod);
  pose.latitude = std::atan2(-rod.y, std::hypot(rod.x, rod.z));
  pose.longitude = std::atan2(rod.x, rod.z);
  pose.roll = roll;
  return pose;
}

RobotHandsMover::RobotHandsMover(RobotJoint& joint, const RobotOptions& options)
    : joint_(joint), options_(options), at_(joint.hands()) {
  const LoadedScene& loaded = joint.loaded();
  for (std::size_t i = 0; i < loaded.scene.tissues.size() && i < loaded.surfaces.size(); ++i)
    tissues_.emplace_back(OrEmpty(loaded.surfaces[i]), loaded.scene.tissues[i].pose);
}

glm::dvec3 RobotHandsMover::InstrumentTip() const {
  return joint_.instrument_portal() + TipInOwnPortal(at_.instrument);
}

// Physiological tremor: a few frequencies from 6 to 12 Hz, whose phases come from the seed.
RodPose RobotHandsMover::Trembling(DeviceRole role, RodPose pose) const {
  constexpr std::array kHertz = {6.1, 8.3, 9.7, 11.9};
  const double amplitude = options_.tremor * std::sqrt(2.0 / kHertz.size());
  const double t = kFrameTime * static_cast<double>(frames_);
  glm::dvec3 off(0.0);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < kHertz.size(); ++i) {
      // A phase per tool, axis and frequency, by the golden ratio.
      const double number = 1 + options_.seed * 24.0 + 12.0 * static_cast<double>(Index(role)) +
                            4.0 * axis + static_cast<double>(i);
      const double phase = std::fmod(number * std::numbers::phi, 1.0);
      off[axis] += amplitude * std::sin(2 * std::numbers::pi * (kHertz[i] * t + phase));
    }
  const double reach = std::max(pose.depth, 0.01);
  pose.latitude += off.y / reach;
  pose.longitude += off.x / reach;
  pose.depth += off.z;
  return pose;
}

bool RobotHandsMover::Frame(const RobotHands& to) {
  at_ = to;
  ++frames_;
  RobotHands hands = to;
  hands.scope = Trembling(DeviceRole::kScope, to.scope);
  hands.instrument = Trembling(DeviceRole::kInstrument, to.instrument);
  return joint_.Advance(hands);
}

bool RobotHandsMover::Wait(double seconds) {
  for (int i = 0; i < FramesOf(seconds); ++i)
    if (!Frame(at_)) return false;
  return true;
}

bool RobotHandsMover::Close(bool closes, double seconds) {
  at_.closes = closes;
  return Wait(seconds);
}

bool RobotHandsMover::Leg(DeviceRole role, const RodPose& to, double speed_share) {
  const RodPose from = role == DeviceRole::kScope ? at_.scope : at_.instrument;
  const double speed = speed_share * options_.speed;
  const double seconds =
      kPeakOfMean * std::max(WayOf(from, to) / speed, std::abs(to.roll - from.roll) / kTurn);
  if (seconds < kShortest && WayOf(from, to) == 0 && from.roll == to.roll)
    return !joint_.HasEnded();
  const int frames = FramesOf(seconds);
  for (int i = 1; i <= frames; ++i) {
    RobotHands hands = at_;
    (role == DeviceRole::kScope ? hands.scope : hands.instrument) =
        Mix(from, to, MinimumJerk(static_cast<double>(i) / frames));
    if (!Frame(hands)) return false;
  }
  return true;
}

bool RobotHandsMover::IsFree(DeviceRole role, const RodPose& pose) const {
  const bool is_scope = role == DeviceRole::kScope;
  RodPose begin = pose;
  begin.depth = is_scope ? 0.0 : kJustInside;
  if (pose.depth <= std::max(kSurely, begin.depth)) return true;
  const glm::dvec3 portal = is_scope ? glm::dvec3(0.0) : joint_.instrument_portal();
  return IsWayFree({joint_.relief(), tissues_}, is_scope ? kScopeClear : kInstrumentClear,
                   portal + TipInOwnPortal(begin), portal + TipInOwnPortal(pose));
}

bool RobotHandsMover::Lead(DeviceRole role, const RodPose& goal) {
  const RodPose from = role == DeviceRole::kScope ? at_.scope : at_.instrument;
  RodPose to = goal;
  to.roll = NearestRoll(goal.roll, from.roll);
  const double first = role == DeviceRole::kScope ? 0.0 : kLift;
  for (double back = first;; back += kWithdraw) {
    RodPose a = from, b = to;
    a.depth = std::min(from.depth, std::max(from.depth - back, kSurely));
    b.depth = std::min(to.depth, std::max(to.depth - back, kSurely));
    bool is_free = true;
    for (int i = 0; i <= kSamples && is_free; ++i)
      is_free = IsFree(role, Mix(a, b, static_cast<double>(i) / kSamples));
    if (!is_free && (a.depth > kSurely || b.depth > kSurely)) continue;
    return Leg(role, a) && Leg(role, b) && Leg(role, to);
  }
}

bool RobotHandsMover::WithdrawInstrument() {
  RodPose out = at_.instrument;
  if (out.depth <= kOut) return !joint_.HasEnded();
  out.depth = kOut;
  return Leg(DeviceRole::kInstrument, out);
}

}  // namespace arthro::simulation
