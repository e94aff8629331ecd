// Driver of a family of devices: converts reports to hands and forces to reports. No thread, no
// clock, no link; allocates nothing. One thread takes reports while another may request output
// reports, whose functions are const and use nothing that Take changes. Device frame, m, N, s.
#pragma once

#include <array>
#include <memory>

#include "simulation/device/codec/report_bytes.h"
#include "simulation/device/device_caps.h"
#include "simulation/device/device_sample.h"

namespace arthro::simulation {

// Newest state of one hand of a device; the caller sets the time of its sample.
struct HandReading {
  DeviceSample sample;     // only buttons for HandInput::kRate
  glm::dvec3 push{0.0};    // kRate: push, −1 to 1
  glm::dvec3 turn{0.0};    // kRate: turn, −1 to 1
  glm::dvec3 joints{0.0};  // rad, joint angles of the arm, used to encode forces
  bool is_homed = true;
};

enum class ReportNews { kRejected, kIgnored, kTaken };

// Bytes to write, the report number first; size 0: nothing to write.
struct OutputReport {
  std::array<std::uint8_t, 96> bytes{};
  std::size_t size = 0;
  ReportBytes span() const noexcept { return {bytes.data(), size}; }
};

class DeviceDriver {
 public:
  DeviceDriver() = default;
  virtual ~DeviceDriver() = default;
  DeviceDriver(const DeviceDriver&) = delete;
  DeviceDriver& operator=(const DeviceDriver&) = delete;

  virtual const DeviceCaps& caps() const noexcept = 0;
  virtual int hands() const noexcept { return 1; }

  // Called by the reading thread. Rejects a foreign or impossible report, and then leaves the hands
  // unchanged.
  virtual ReportNews Take(ReportBytes report) noexcept = 0;
  virtual HandReading Hand(int hand) const noexcept = 0;
  virtual void Forget() noexcept = 0;  // call after opening, or after silence
  // Homing of devices whose counters must be set. The user confirms that the handle is in its rest,
  // by the button of the device or by AskHome; then HomeReport is to be written until the hands are
  // homed.
  virtual void AskHome() noexcept {}
  virtual bool WantsHome() const noexcept { return false; }

  // Called by the writing thread.
  virtual OutputReport ForceReport(const glm::dvec3& /*force*/,
                                   const glm::dvec3& /*joints*/) const noexcept {
    return {};
  }
  virtual OutputReport HomeReport() const noexcept { return {}; }
  // Feature reports that begin and end the reports of the device.
  virtual OutputReport StartFeature() const noexcept { return {}; }
  virtual OutputReport StopFeature() const noexcept { return {}; }
  // s, least time between two force reports; 0: no limit.
  virtual double command_interval() const noexcept { return 0; }
};

}  // namespace arthro::simulation
