#include "simulation/practice/scripted_device.h"

#include <algorithm>

namespace arthro::simulation {
namespace {

// Least distance of the hand from the incision, where the rod still has a direction.
constexpr double kHandClearance = 0.02;  // m

RodPose Within(const RodPose& pose, const RodLimits& limits, double rod_length) noexcept {
  return {std::clamp(pose.latitude, -limits.max_latitude, limits.max_latitude),
          std::clamp(pose.longitude, -limits.max_longitude, limits.max_longitude), pose.roll,
          std::clamp(
              pose.depth, limits.min_depth,
              std::max(limits.min_depth, std::min(limits.max_depth, rod_length - kHandClearance)))};
}

}  // namespace

ScriptedDevice::ScriptedDevice(const DeviceRig& rig, const RodPose& start, const RodLimits& limits)
    : rig_(rig), limits_(limits), pose_(Within(start, limits, rig.rod_length)), sampled_(pose_) {}

void ScriptedDevice::Set(const RodPose& pose) noexcept {
  pose_ = Within(pose, limits_, rig_.rod_length);
}

void ScriptedDevice::Advance(const RodPose& change) noexcept {
  Set({pose_.latitude + change.latitude, pose_.longitude + change.longitude,
       pose_.roll + change.roll, pose_.depth + change.depth});
}

DeviceSample ScriptedDevice::Sample(double t, double remaining) noexcept {
  const double step = t - sampled_t_, whole = step + remaining;
  const double s = remaining > 0.0 && step >= 0.0 ? step / whole : 1.0;
  sampled_.latitude += s * (pose_.latitude - sampled_.latitude);
  sampled_.longitude += s * (pose_.longitude - sampled_.longitude);
  sampled_.roll += s * (pose_.roll - sampled_.roll);
  sampled_.depth += s * (pose_.depth - sampled_.depth);
  sampled_t_ = t;
  return {t, HipFromRodPose(sampled_, rig_), HandleFromRodPose(sampled_, rig_), buttons_, true};
}

}  // namespace arthro::simulation
