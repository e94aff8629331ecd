// What one family of devices means by its bytes: reports to hands, forces to reports. No thread, no
// clock, no link; none of it allocates. One thread takes reports, another may ask for output
// reports meanwhile: those functions are const and use nothing that Take changes. Device frame, m,
// N, s.
#pragma once

#include <array>
#include <memory>

#include "simulation/device/codec/report_bytes.h"
#include "simulation/device/device_caps.h"
#include "simulation/device/device_sample.h"

namespace arthro::simulation {

// One hand of a device, as its reports said last. Its time is the caller's to write.
struct HandReading {
  DeviceSample sample;     // where HandInput is kRate, only its buttons
  glm::dvec3 push{0.0};    // of kRate, −1 to 1: how hard it is pushed …
  glm::dvec3 turn{0.0};    // … and turned
  glm::dvec3 joints{0.0};  // rad, of the arm: what forces are encoded with
  bool is_homed = true;
};

enum class ReportNews { kRejected, kIgnored, kTaken };

// Bytes to write, the report's number first; of size 0 there is nothing to write.
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

  // The thread that reads. Rejected: no report of this device, or one that cannot be; the hands
  // stay as they were.
  virtual ReportNews Take(ReportBytes report) noexcept = 0;
  virtual HandReading Hand(int hand) const noexcept = 0;
  virtual void Forget() noexcept = 0;  // after the device was opened, or was silent
  // Where counters must be set: somebody says that the handle is in its rest, by the device's own
  // button or by AskHome; then HomeReport is to be written until the hands are homed.
  virtual void AskHome() noexcept {}
  virtual bool WantsHome() const noexcept { return false; }

  // The thread that writes.
  virtual OutputReport ForceReport(const glm::dvec3& /*force*/,
                                   const glm::dvec3& /*joints*/) const noexcept {
    return {};
  }
  virtual OutputReport HomeReport() const noexcept { return {}; }
  // Feature reports that begin and end what the device sends.
  virtual OutputReport StartFeature() const noexcept { return {}; }
  virtual OutputReport StopFeature() const noexcept { return {}; }
  // s, between two force reports at least; 0: each that comes.
  virtual double command_interval() const noexcept { return 0; }
};

}  // namespace arthro::simulation
