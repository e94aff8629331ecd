#include <algorithm>

#include "simulation/device/codec/razer_hydra.h"
#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

constexpr double kPulled = 0.5;             // travel of the trigger
constexpr std::uint32_t kTrigger = 1 << 7;  // bit after the seven buttons

class HydraDriver final : public DeviceDriver {
 public:
  HydraDriver() {
    caps_.input = HandInput::kAbsolute;
    caps_.sensed_dof = 6;
    caps_.position_quantum = 1e-3;
    // rad; the maker states no value. It is a magnetic tracker: calibrate with a wide swing.
    caps_.gimbal_sigma = 0.01;
    caps_.rate = 250;
    caps_.min_hip = glm::dvec3(-0.5);
    caps_.max_hip = glm::dvec3(0.5);
    caps_.buttons = 8;
  }
  const DeviceCaps& caps() const noexcept override { return caps_; }
  int hands() const noexcept override { return 2; }

  ReportNews Take(ReportBytes report) noexcept override {
    const auto hands = ParseHydra(report);
    if (!hands) return ReportNews::kRejected;
    hands_ = *hands;
    return ReportNews::kTaken;
  }
  HandReading Hand(int hand) const noexcept override {
    const HydraHand& from = hands_[static_cast<std::size_t>(std::clamp(hand, 0, 1))];
    HandReading reading;
    reading.sample.hip_in_device = from.position;
    reading.sample.handle_in_device = from.orientation;
    reading.sample.buttons = from.buttons | (from.trigger > kPulled ? kTrigger : 0);
    reading.sample.valid = true;
    return reading;
  }
  void Forget() noexcept override { hands_ = {}; }

  OutputReport StartFeature() const noexcept override { return Motion(true); }
  OutputReport StopFeature() const noexcept override { return Motion(false); }

 private:
  static OutputReport Motion(bool is_on) noexcept {
    const auto report = HydraMotionReport(is_on);
    OutputReport output;
    std::copy(report.begin(), report.end(), output.bytes.begin());
    output.size = report.size();
    return output;
  }
  DeviceCaps caps_;
  std::array<HydraHand, 2> hands_{};
};

}  // namespace

std::unique_ptr<DeviceDriver> MakeHydraDriver() { return std::make_unique<HydraDriver>(); }

}  // namespace arthro::simulation
