#include "simulation/device/recorded_device.h"

#include <glm/common.hpp>

namespace arthro::simulation {

RecordedDevice::RecordedDevice(std::span<const TraceRow> rows, DeviceRole role) {
  caps_.input = HandInput::kAbsolute;
  for (const TraceRow& row : rows)
    if (row.device == role) samples_.push_back(row.sample);
}

DeviceSample RecordedDevice::At(double t) noexcept {
  while (next_ < samples_.size() && samples_[next_].t <= t) ++next_;
  DeviceSample sample;
  sample.t = t;
  if (next_ == 0) return sample;
  const DeviceSample& before = samples_[next_ - 1];
  if (before.t == t) return before;
  if (next_ == samples_.size()) return sample;
  const DeviceSample& after = samples_[next_];
  const double s = (t - before.t) / (after.t - before.t);
  sample.hip_in_device = glm::mix(before.hip_in_device, after.hip_in_device, s);
  sample.handle_in_device = glm::slerp(before.handle_in_device, after.handle_in_device, s);
  sample.buttons = before.buttons;
  sample.valid = true;
  return sample;
}

}  // namespace arthro::simulation
