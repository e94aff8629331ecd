// Device whose samples and commands are logged.
#pragma once

#include <memory>

#include "simulation/device/device.h"
#include "simulation/device/live/report_tap.h"
#include "simulation/device/log/device_log.h"

namespace arthro::simulation {

// Replaces the device that it wraps. Writes a record at each Command, which ends a tick.
class LoggedDevice final : public Device {
 public:
  // `source` is that of the log, `hand` that of the source. The log must outlive this.
  LoggedDevice(std::unique_ptr<Device> device, DeviceLog& log, int source, int hand = 0);

  const DeviceCaps& caps() const noexcept override { return device_->caps(); }
  const std::string& name() const noexcept override { return device_->name(); }
  const std::string& serial() const noexcept override { return device_->serial(); }
  DeviceSample Read(double now) noexcept override;
  void HoldDeadMan(bool is_held) noexcept override;
  void Command(const glm::dvec3& force_in_device) noexcept override;
  DeviceStatus status() const noexcept override { return device_->status(); }

 private:
  std::unique_ptr<Device> device_;
  LogChannel& channel_;
  LogRecord tick_;
};

// Logs each report of a link with the state that its driver decoded. Pass it in LiveOptions; the
// log and this must outlive the link.
class LoggedReports final : public ReportTap {
 public:
  LoggedReports(DeviceLog& log, int source);
  void Opened(double t, const HidNode& node) noexcept override;
  void HomeAsked(double t) noexcept override;
  void Took(double t, ReportBytes report, ReportNews news,
            const DeviceDriver& driver) noexcept override;

 private:
  LogChannel& channel_;
  LogRecord record_;
};

}  // namespace arthro::simulation
