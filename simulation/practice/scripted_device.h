// A hand without a device: mouse, keys or a script move a rod, and the rod is converted to the
// sample that a device held there would give. The code behind it is the same as with a real device.
#pragma once

#include "simulation/device/device_sample.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {

// Range of a hand; rad and m. A negative insertion draws the tip out of the joint.
struct RodLimits {
  double max_latitude = 1.3;
  double max_longitude = 1.3;
  double min_depth = -0.02;
  double max_depth = 0.12;  // kept below the rod length, so that the hand stays outside
};

class ScriptedDevice {
 public:
  explicit ScriptedDevice(const DeviceRig& rig, const RodPose& start = {},
                          const RodLimits& limits = {});

  const DeviceRig& rig() const noexcept { return rig_; }
  void SetRig(const DeviceRig& rig) noexcept { rig_ = rig; }  // the pose is kept
  const RodPose& pose() const noexcept { return pose_; }
  void Set(const RodPose& pose) noexcept;        // clamps to the limits
  void Advance(const RodPose& change) noexcept;  // adds to the four values
  void SetButtons(std::uint32_t buttons) noexcept { buttons_ = buttons; }

  // Moves the sampled hand at constant speed from its last sample to pose(), over the ticks of one
  // displayed frame. `t` must rise; `remaining` is the time in s from t to the end of the frame, 0
  // to arrive now.
  DeviceSample Sample(double t, double remaining = 0.0) noexcept;

 private:
  DeviceRig rig_;
  RodLimits limits_;
  RodPose pose_, sampled_;
  double sampled_t_ = 0;
  std::uint32_t buttons_ = 0;
};

}  // namespace arthro::simulation
