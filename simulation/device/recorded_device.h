// A device that plays a recording. Between two rows the hand moves evenly (a straight line, the
// shorter turn), so that a slow recording does not move in jerks; at a row it is that row, bit for
// bit. Before its first row and after its last there is no device. Device frame, m, s.
#pragma once

#include <span>
#include <vector>

#include "simulation/device/trace_io.h"

namespace arthro::simulation {

class RecordedDevice {
 public:
  RecordedDevice(std::span<const TraceRow> rows, DeviceRole role);

  bool empty() const { return samples_.empty(); }
  // Call with t rising. Of several rows with the same t the last counts.
  DeviceSample At(double t) noexcept;

 private:
  std::vector<DeviceSample> samples_;
  std::size_t next_ = 0;  // the first sample later than the last t asked for
};

}  // namespace arthro::simulation
