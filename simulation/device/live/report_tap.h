// Observer of all reports between a driver and its device, for a log. Called by the reading thread;
// must not wait. s, on the clock of the link.
#pragma once

#include "simulation/device/driver/device_driver.h"
#include "simulation/device/hid/hid_node.h"

namespace arthro::simulation {

class ReportTap {
 public:
  virtual ~ReportTap() = default;
  // The driver is in the state after Forget.
  virtual void Opened(double t, const HidNode& node) noexcept = 0;
  virtual void HomeAsked(double t) noexcept = 0;
  // `driver` has taken `report` and returned `news`.
  virtual void Took(double t, ReportBytes report, ReportNews news,
                    const DeviceDriver& driver) noexcept = 0;
};

}  // namespace arthro::simulation
