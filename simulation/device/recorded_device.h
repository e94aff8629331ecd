// A device that plays a recording. Between two rows the hand moves at constant speed along a
// straight line and the handle along the shorter arc. At the time of a row the sample is that row,
// bit for bit. Before the first row and after the last there is no valid sample. Device frame, m,
// s.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/device/device.h"
#include "simulation/device/trace_io.h"

namespace arthro::simulation {

class RecordedDevice final : public Device {
 public:
  RecordedDevice(std::span<const TraceRow> rows, DeviceRole role);

  bool empty() const { return samples_.empty(); }
  // Sample at time `t` of the recording, which must rise from call to call. The last of several
  // rows with the same t counts.
  DeviceSample At(double t) noexcept;

  const DeviceCaps& caps() const noexcept override { return caps_; }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return serial_; }
  DeviceSample Read(double now) noexcept override { return At(now); }
  void HoldDeadMan(bool /*is_held*/) noexcept override {}
  void Command(const glm::dvec3& /*force_in_device*/) noexcept override {}
  DeviceStatus status() const noexcept override { return {DeviceState::kReady, {}, false}; }

 private:
  DeviceCaps caps_;  // absolute positions, no force
  std::string name_ = "recorded hand", serial_;
  std::vector<DeviceSample> samples_;
  std::size_t next_ = 0;  // first sample that is later than the last t
};

}  // namespace arthro::simulation
