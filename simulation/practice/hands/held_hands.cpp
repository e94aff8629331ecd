#include "simulation/practice/hands/held_hands.h"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

namespace arthro::simulation {

namespace {

constexpr std::uint32_t kActs = 1, kDeadMan = 2;  // bits: button of the session, of its servo
constexpr double kRounding = 1e-9;                // s, error of a difference of two times

bool IsDown(const RigButtons& buttons, RigAction action, std::uint32_t down) noexcept {
  const int button = buttons[static_cast<std::size_t>(action)];
  return button >= 0 && (down >> button & 1u) != 0;
}

const std::string kByMouse = "mouse and keys";
const DeviceCaps kNoCaps;

}  // namespace

class HeldHands::Hand final : public Device {
 public:
  Hand(HeldHands& both, DeviceRole role, HandParts parts)
      : both_(both), role_(role), parts_(std::move(parts)) {}

  const DeviceCaps& caps() const noexcept override {
    return parts_.device ? parts_.device->caps() : kNoCaps;
  }
  const std::string& name() const noexcept override {
    return parts_.device ? parts_.device->name() : kByMouse;
  }
  const std::string& serial() const noexcept override {
    return parts_.device ? parts_.device->serial() : kNoSerial;
  }
  DeviceStatus status() const noexcept override {
    return parts_.device ? parts_.device->status() : DeviceStatus{};
  }

  DeviceSample Read(double now) noexcept override {
    both_.BeginTick(now);
    const HandsRequest::Hand& request = both_.request_.hand[Index(role_)];
    HandsReport::Hand& report = both_.report_.hand[Index(role_)];
    if (request.mount && parts_.led == nullptr) parts_.by_mouse.SetRig(*request.mount);
    if (request.episode == report.episode) parts_.by_mouse.Set(request.pose);
    const double remaining = both_.request_.until - now;
    const DeviceSample by_mouse =
        parts_.by_mouse.Sample(now, remaining > kRounding ? remaining : 0.0);

    DeviceSample sample;
    buttons_ = 0;
    if (parts_.recorded) {
      if (!began_) began_ = now;
      sample = parts_.recorded->At(now - *began_ + parts_.recording_begins);
      sample.t = now;
      buttons_ = sample.buttons & kActs;
    } else if (parts_.led != nullptr) {
      parts_.led->SetIntent(by_mouse.hip_in_device);
      sample = parts_.device->Read(now);
      // The rod goes through the incision wherever the hand is pushed to.
      const DeviceRig& rig = parts_.by_mouse.rig();
      sample.handle_in_device =
          HandleFromRodPose(RodPoseFromHip(parts_.led->position(), by_mouse.handle_in_device, rig,
                                           parts_.by_mouse.pose()),
                            rig);
    } else if (parts_.device) {
      if (parts_.integrates != nullptr && !report.is_led_by_device)
        parts_.integrates->SetRateHand({by_mouse.hip_in_device, by_mouse.handle_in_device});
      sample = parts_.device->Read(now);
      pressed_ = IsReady(parts_.device->state()) ? sample.buttons : 0;
    }
    if (both_.request_.calibrated == role_) PublishSample(sample);
    report.age = sample.valid ? std::max(0.0, now - sample.t) : 0.0;
    const bool is_led = sample.valid && parts_.led == nullptr;
    if (!is_led && report.is_led_by_device) ++report.episode;
    if (!sample.valid) sample = by_mouse;
    report.is_led_by_device = is_led;
    read_at_ = now;

    sample.buttons = buttons_ | (request.buttons & kActs);
    if (role_ == DeviceRole::kInstrument && both_.IsHeld(RigAction::kCloseJaws))
      sample.buttons |= kActs;
    // A button of a handle counts for its own hand, a pedal for both.
    if (IsDown(parts_.buttons, RigAction::kDeadMan, pressed_) ||
        IsDown(both_.pedals_.buttons, RigAction::kDeadMan, both_.pedal_sample_.buttons))
      sample.buttons |= kDeadMan;
    return sample;
  }

  void HoldDeadMan(bool is_held) noexcept override {
    is_held = is_held && !both_.request_.calibrated;
    both_.report_.hand[Index(role_)].is_dead_man_held = is_held;
    if (parts_.device) parts_.device->HoldDeadMan(is_held);
  }

  void Command(const glm::dvec3& force) noexcept override {
    const glm::dvec3 force_in_device = both_.request_.calibrated ? glm::dvec3(0.0) : force;
    if (parts_.device) parts_.device->Command(force_in_device);
    HandsReport::Hand& report = both_.report_.hand[Index(role_)];
    report.given =
        HasForce(caps()) && state() == DeviceState::kArmed ? glm::length(force_in_device) : 0.0;
    // A pad rumbles in proportion to the force on the instrument's hand, without a dead-man.
    if (role_ != DeviceRole::kInstrument || !both_.pedals_.device ||
        both_.pedals_.device->caps().feedback != Feedback::kRumble)
      return;
    both_.pedals_.device->HoldDeadMan(IsReady(both_.pedals_.device->state()));
    both_.pedals_.device->Command({glm::length(force_in_device), 0, 0});
  }

  // Lets mouse and keys continue from the pose that the session computed for a device's sample.
  void FollowDevice(const RodPose& pose) noexcept {
    if (!both_.report_.hand[Index(role_)].is_led_by_device) return;
    parts_.by_mouse.Set(pose);
    parts_.by_mouse.Sample(read_at_);
  }

  bool IsHeld(RigAction action) const noexcept { return IsDown(parts_.buttons, action, pressed_); }
  HandKind kind() const noexcept { return parts_.kind; }
  const RodPose& pose() const noexcept { return parts_.by_mouse.pose(); }

 private:
  // Queues each sample once: a device may report less often than it is read.
  void PublishSample(const DeviceSample& sample) noexcept {
    if (!parts_.device && !parts_.recorded) return;
    if (sample.valid && sample.t == sample_t_) return;
    sample_t_ = sample.t;
    both_.samples_.Push(sample);
  }

  static inline const std::string kNoSerial;
  HeldHands& both_;
  DeviceRole role_;
  HandParts parts_;
  std::uint32_t buttons_ = 0;    // bit field, buttons of the session
  std::uint32_t pressed_ = 0;    // bit field, buttons of the device
  std::optional<double> began_;  // s, when the recording was started
  double read_at_ = 0;           // s, time of the newest tick
  double sample_t_ = -1;         // s, time of the sample that was queued last
};

HeldHands::HeldHands(std::array<HandParts, 2> parts, PedalParts pedals)
    : pedals_(std::move(pedals)) {
  for (const DeviceRole role : kDeviceRoles) {
    const std::size_t i = Index(role);
    auto hand = std::make_unique<Hand>(*this, role, std::move(parts[i]));
    hands_[i] = hand.get();
    devices_[i] = std::move(hand);
    request_.hand[i].pose = hands_[i]->pose();
  }
}

HeldHands::~HeldHands() = default;

void HeldHands::LogTo(DeviceLog& log, DeviceRole role, int source, int hand) {
  auto& device = devices_[Index(role)];
  device = std::make_unique<LoggedDevice>(std::move(device), log, source, hand);
}

Device* HeldHands::Of(DeviceRole role) noexcept { return devices_[Index(role)].get(); }

HandKind HeldHands::KindOf(DeviceRole role) const noexcept { return hands_[Index(role)]->kind(); }

// Called by the hand that is read first in a tick.
void HeldHands::BeginTick(double now) noexcept {
  if (now == tick_) return;
  tick_ = now;
  if (requests_.HasNew()) request_ = requests_.Read();
  if (!pedals_.device) return;
  pedal_sample_ = pedals_.device->Read(now);
  if (!IsReady(pedals_.device->state())) pedal_sample_.buttons = 0;
}

bool HeldHands::ReadSample(DeviceSample& sample) noexcept {
  const DeviceSample* oldest = samples_.Front();
  if (oldest == nullptr) return false;
  sample = *oldest;
  samples_.Pop();
  return true;
}

bool HeldHands::IsHeld(RigAction action) const noexcept {
  if (request_.calibrated) return false;
  return IsDown(pedals_.buttons, action, pedal_sample_.buttons) || hands_[0]->IsHeld(action) ||
         hands_[1]->IsHeld(action);
}

void HeldHands::AfterTick(const Snapshot& snapshot, double dt) noexcept {
  for (const DeviceRole role : kDeviceRoles) {
    const ToolState& state = ToolOf(snapshot, role);
    HandsReport::Hand& report = report_.hand[Index(role)];
    report.felt = glm::length(state.hand_force);
    report.fault = state.fault;
    report.status = hands_[Index(role)]->status();
    if (report.status.state == DeviceState::kFault || report.status.state == DeviceState::kLost)
      report.last_fault = report.status;
    hands_[Index(role)]->FollowDevice(state.pose);
    report.history.Feel(report.felt);
    report.history.Pass(dt, report.age);
  }
  const bool is_next_held = IsHeld(RigAction::kNextInstrument);
  if (is_next_held && !std::exchange(was_next_held_, is_next_held)) ++report_.next_presses;
  was_next_held_ = is_next_held;
  report_.peak_force = std::max(report_.peak_force, glm::length(snapshot.instrument.tip_force));
  if (snapshot.instrument.is_running) report_.running += dt;
  reports_.Write(report_);
}

}  // namespace arthro::simulation
