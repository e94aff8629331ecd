#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/device/codec/rumble_pad.h"
#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

constexpr double kFullForce = 3.3;  // N, force at full rumble; peak of a Touch

class PadDriver final : public DeviceDriver {
 public:
  PadDriver(DeviceFamily family, bool is_bluetooth) : family_(family), is_bluetooth_(is_bluetooth) {
    caps_.feedback = Feedback::kRumble;
    caps_.peak_force = kFullForce;
    caps_.rate = 250;
    caps_.buttons = kPadButtons;
  }
  const DeviceCaps& caps() const noexcept override { return caps_; }

  ReportNews Take(ReportBytes report) noexcept override {
    const auto buttons =
        family_ == DeviceFamily::kDualSense ? ParseDualSense(report) : ParseDualShock4(report);
    if (!buttons) return ReportNews::kRejected;
    buttons_ = *buttons;
    return ReportNews::kTaken;
  }
  // A pad has no hand and reports buttons only.
  HandReading Hand(int /*hand*/) const noexcept override {
    HandReading hand;
    hand.sample.buttons = buttons_;
    return hand;
  }
  void Forget() noexcept override { buttons_ = 0; }

  OutputReport ForceReport(const glm::dvec3& force,
                           const glm::dvec3& /*joints*/) const noexcept override {
    const double amplitude = glm::length(force) / kFullForce;
    const Rumble rumble{amplitude, amplitude};
    if (family_ == DeviceFamily::kDualSense)
      return is_bluetooth_ ? Output(DualSenseBluetooth(rumble)) : Output(DualSenseUsb(rumble));
    return is_bluetooth_ ? Output(DualShock4Bluetooth(rumble)) : Output(DualShock4Usb(rumble));
  }
  double command_interval() const noexcept override { return 1.0 / 60; }

 private:
  template <std::size_t kSize>
  static OutputReport Output(const std::array<std::uint8_t, kSize>& report) noexcept {
    OutputReport output;
    std::copy(report.begin(), report.end(), output.bytes.begin());
    output.size = kSize;
    return output;
  }
  DeviceFamily family_;
  bool is_bluetooth_;
  DeviceCaps caps_;
  std::uint32_t buttons_ = 0;
};

}  // namespace

std::unique_ptr<DeviceDriver> MakePadDriver(DeviceFamily family, bool is_bluetooth) {
  return std::make_unique<PadDriver>(family, is_bluetooth);
}

}  // namespace arthro::simulation
