// A hand without a device: mouse, keys or a script move a rod, and the rod is turned into the
// sample that a device held there would give. Everything behind it is the same code as with a real
// device.
#pragma once

#include "simulation/device/device_sample.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {

// How far a hand may go; rad and m. Insertion may be negative: the tip is drawn out of the joint.
struct RodLimits {
  double max_latitude = 1.3;
  double max_longitude = 1.3;
  double min_depth = -0.02;
  double max_depth = 0.12;  // kept below the rod's length, so that the hand stays outside
};

class ScriptedDevice {
 public:
  explicit ScriptedDevice(const DeviceRig& rig, const RodPose& start = {},
                          const RodLimits& limits = {});

  const DeviceRig& rig() const noexcept { return rig_; }
  void SetRig(const DeviceRig& rig) noexcept { rig_ = rig; }  // the same pose, elsewhere
  const RodPose& pose() const noexcept { return pose_; }
  void Set(const RodPose& pose) noexcept;        // kept within the limits
  void Advance(const RodPose& change) noexcept;  // adds to each of the four
  void SetButtons(std::uint32_t buttons) noexcept { buttons_ = buttons; }

  // Moves the sampled hand evenly from where it was to pose() over the ticks of one displayed
  // frame: call with t rising, `remaining` the time from t to the end of the frame (0: be there
  // now).
  DeviceSample Sample(double t, double remaining = 0.0) noexcept;

 private:
  DeviceRig rig_;
  RodLimits limits_;
  RodPose pose_, sampled_;
  double sampled_t_ = 0;
  std::uint32_t buttons_ = 0;
};

}  // namespace arthro::simulation
