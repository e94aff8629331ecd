// Who wants to know all that passes between a driver and its device: a log. Called by the thread
// that reads; must not wait. s, on the link's clock.
#pragma once

#include "simulation/device/driver/device_driver.h"
#include "simulation/device/hid/hid_node.h"

namespace arthro::simulation {

class ReportTap {
 public:
  virtual ~ReportTap() = default;
  // The driver is as after Forget.
  virtual void Opened(double t, const HidNode& node) noexcept = 0;
  virtual void HomeAsked(double t) noexcept = 0;
  // `driver` has taken `report`, and said `news` of it.
  virtual void Took(double t, ReportBytes report, ReportNews news,
                    const DeviceDriver& driver) noexcept = 0;
};

}  // namespace arthro::simulation
