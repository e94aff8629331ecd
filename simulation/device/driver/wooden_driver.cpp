#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

constexpr std::uint16_t kHomeButton = 1;  // bit of info, set by the board until it is homed
constexpr double kLargestStep = 0.005;    // m per report; no hand moves at 5 m/s
// counts; a resting handle trembles less, and counters that were not set differ by more
constexpr int kAtHome = 50;
// Share of the peak force. Assumes that a third of the current may flow permanently; the data sheet
// of the motors was not consulted.
constexpr double kContinuous = 1.0 / 3;
constexpr double kLongestWatchdog = 0.5;  // s, longest of both known boards

// Returns the smallest step of the hand that a counter resolves, at its coarsest joint, with the
// arm at rest.
double QuantumOf(const WoodenModel& model) {
  std::array<std::int64_t, 6> home{};
  std::copy(model.home.begin(), model.home.end(), home.begin());
  const glm::dmat3 jacobian = WoodenJacobian(model.arm, WoodenAngles(model.arm, home));
  double coarsest = 0;
  for (int i = 0; i < 3; ++i)
    coarsest = std::max(coarsest, glm::length(jacobian[i]) * model.arm.transmission[i]);
  return coarsest * 2 * std::numbers::pi / model.arm.counts_per_turn;
}

class WoodenDriver final : public DeviceDriver {
 public:
  WoodenDriver(const WoodenModel& model, bool is_padded)
      : model_(model),
        size_(is_padded ? 65 : 15),
        unwrap_(static_cast<int>(kLargestStep / QuantumOf(model))) {
    caps_.input = HandInput::kAbsolute;
    caps_.feedback = Feedback::kForce;
    caps_.sensed_dof = model.has_gimbal ? 6 : 3;
    caps_.actuated_dof = 3;
    caps_.position_quantum = QuantumOf(model);
    if (model.has_gimbal)  // uniform error within a count
      caps_.gimbal_sigma =
          2 * std::numbers::pi / model.arm.gimbal_counts_per_turn / std::sqrt(12.0);
    caps_.peak_force = model.peak_force;
    caps_.continuous_force = kContinuous * model.peak_force;
    caps_.max_stiffness = model.max_stiffness;
    caps_.rate = 1000;
    caps_.delay_ticks = 1;
    caps_.min_hip = glm::dvec3(-model.reach);
    caps_.max_hip = glm::dvec3(model.reach);
    caps_.buttons = model.has_gimbal ? 1 : 0;
    caps_.watchdog = kLongestWatchdog;
  }

  const DeviceCaps& caps() const noexcept override { return caps_; }

  ReportNews Take(ReportBytes bytes) noexcept override {
    auto report = ParseWooden(bytes);
    if (!report) return ReportNews::kRejected;
    bool is_pressed = false;
    if (model_.has_gimbal) {
      is_pressed = TakePolhemButton(*report);
      std::swap(report->encoder[3], report->encoder[5]);
    }
    const bool is_set = wants_home_ && IsAtHome(*report);
    if (is_set) unwrap_.Forget();
    if (!unwrap_.Take(report->encoder)) return ReportNews::kRejected;
    if (is_set) {
      wants_home_ = false;
      hand_.is_homed = true;
    }
    if (report->info & kHomeButton) AskHome();
    hand_.joints = WoodenAngles(model_.arm, unwrap_.total());
    hand_.sample.hip_in_device = WoodenPosition(model_.arm, hand_.joints);
    hand_.sample.handle_in_device = WoodenHandle(model_.arm, hand_.joints, unwrap_.total());
    hand_.sample.buttons = is_pressed ? 1 : 0;
    hand_.sample.valid = true;
    return ReportNews::kTaken;
  }

  HandReading Hand(int /*hand*/) const noexcept override { return hand_; }

  void Forget() noexcept override {
    unwrap_.Forget();
    hand_ = {};
    hand_.is_homed = false;
    wants_home_ = false;
  }
  // The position is unknown until the counters are set.
  void AskHome() noexcept override {
    wants_home_ = true;
    hand_.is_homed = false;
  }
  bool WantsHome() const noexcept override { return wants_home_; }

  OutputReport ForceReport(const glm::dvec3& force,
                           const glm::dvec3& joints) const noexcept override {
    return Padded(WoodenCurrentReport(WoodenCurrents(model_.arm, joints, force)));
  }
  OutputReport HomeReport() const noexcept override {
    auto counts = model_.home;
    if (model_.has_gimbal) std::swap(counts[3], counts[5]);
    return Padded(WoodenCounterReport(counts));
  }

 private:
  OutputReport Padded(const WoodenOutput& report) const noexcept {
    OutputReport output;
    std::copy(report.begin(), report.end(), output.bytes.begin());
    output.size = size_;
    return output;
  }
  bool IsAtHome(const WoodenReport& report) const noexcept {
    if (report.info & kHomeButton) return false;
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(report.encoder[i] - model_.home[i]) > kAtHome) return false;
    return true;
  }

  WoodenModel model_;
  std::size_t size_;
  DeviceCaps caps_;
  EncoderUnwrap unwrap_;
  HandReading hand_ = [] {
    HandReading hand;
    hand.is_homed = false;
    return hand;
  }();
  bool wants_home_ = false;
};

}  // namespace

std::unique_ptr<DeviceDriver> MakeWoodenDriver(const WoodenModel& model, bool is_padded) {
  return std::make_unique<WoodenDriver>(model, is_padded);
}

}  // namespace arthro::simulation
