#include "simulation/practice/hands/held_hands.h"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

namespace arthro::simulation {

namespace {

constexpr std::uint32_t kActs = 1, kDeadMan = 2;  // buttons of the session and of its servo
constexpr double kRounding = 1e-9;                // s, of a difference of two times

std::size_t Index(DeviceRole role) noexcept { return static_cast<std::size_t>(role); }

bool IsReady(DeviceState state) noexcept {
  return state == DeviceState::kReady || state == DeviceState::kArmed;
}

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
    const HandsWish::Hand& wish = both_.wish_.hand[Index(role_)];
    HandsNews::Hand& told = both_.told_.hand[Index(role_)];
    if (wish.mount && parts_.led == nullptr) parts_.by_mouse.SetRig(*wish.mount);
    if (wish.episode == told.episode) parts_.by_mouse.Set(wish.pose);
    const double remaining = both_.wish_.until - now;
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
      // Its rod goes through the incision, wherever the hand is pushed to.
      const DeviceRig& rig = parts_.by_mouse.rig();
      sample.handle_in_device =
          HandleFromRodPose(RodPoseFromHip(parts_.led->position(), by_mouse.handle_in_device, rig,
                                           parts_.by_mouse.pose()),
                            rig);
    } else if (parts_.device) {
      if (parts_.integrates != nullptr && !told.is_led_by_device)
        parts_.integrates->SetRateHand({by_mouse.hip_in_device, by_mouse.handle_in_device});
      sample = parts_.device->Read(now);
      pressed_ = IsReady(parts_.device->state()) ? sample.buttons : 0;
    }
    if (both_.wish_.calibrated == role_) Tell(sample);
    told.age = sample.valid ? std::max(0.0, now - sample.t) : 0.0;
    const bool is_led = sample.valid && parts_.led == nullptr;
    if (is_led) {
      // Mouse and keys go on from where it leaves the hand.
      led_pose_ = RodPoseFromHip(sample.hip_in_device, sample.handle_in_device,
                                 parts_.by_mouse.rig(), led_pose_);
      parts_.by_mouse.Set(led_pose_);
      parts_.by_mouse.Sample(now);
    } else {
      if (told.is_led_by_device) ++told.episode;
      led_pose_ = parts_.by_mouse.pose();
      if (!sample.valid) sample = by_mouse;
    }
    told.is_led_by_device = is_led;

    sample.buttons = buttons_ | (wish.buttons & kActs);
    if (role_ == DeviceRole::kInstrument && both_.IsHeld(RigAction::kCloseJaws))
      sample.buttons |= kActs;
    // A handle's button is for its own hand, a pedal for both.
    if (IsDown(parts_.buttons, RigAction::kDeadMan, pressed_) ||
        IsDown(both_.pedals_.buttons, RigAction::kDeadMan, both_.pedal_sample_.buttons))
      sample.buttons |= kDeadMan;
    return sample;
  }

  void HoldDeadMan(bool is_held) noexcept override {
    is_held = is_held && !both_.wish_.calibrated;
    both_.told_.hand[Index(role_)].is_dead_man_held = is_held;
    if (parts_.device) parts_.device->HoldDeadMan(is_held);
  }

  void Command(const glm::dvec3& force) noexcept override {
    const glm::dvec3 force_in_device = both_.wish_.calibrated ? glm::dvec3(0.0) : force;
    if (parts_.device) parts_.device->Command(force_in_device);
    HandsNews::Hand& told = both_.told_.hand[Index(role_)];
    told.given =
        HasForce(caps()) && state() == DeviceState::kArmed ? glm::length(force_in_device) : 0.0;
    // A pad rumbles with what the instrument's hand feels; nobody needs a dead-man against that.
    if (role_ != DeviceRole::kInstrument || !both_.pedals_.device ||
        both_.pedals_.device->caps().feedback != Feedback::kRumble)
      return;
    both_.pedals_.device->HoldDeadMan(IsReady(both_.pedals_.device->state()));
    both_.pedals_.device->Command({glm::length(force_in_device), 0, 0});
  }

  bool IsHeld(RigAction action) const noexcept { return IsDown(parts_.buttons, action, pressed_); }
  HandKind kind() const noexcept { return parts_.kind; }
  const RodPose& pose() const noexcept { return parts_.by_mouse.pose(); }

 private:
  // Once; a device may speak less often than it is asked.
  void Tell(const DeviceSample& sample) noexcept {
    if (!parts_.device && !parts_.recorded) return;
    if (sample.valid && sample.t == told_t_) return;
    told_t_ = sample.t;
    both_.heard_.Push(sample);
  }

  static inline const std::string kNoSerial;
  HeldHands& both_;
  DeviceRole role_;
  HandParts parts_;
  RodPose led_pose_;
  std::uint32_t buttons_ = 0, pressed_ = 0;  // of the session; of the device
  std::optional<double> began_;              // the recording
  double told_t_ = -1;                       // of the sample that was heard last
};

HeldHands::HeldHands(std::array<HandParts, 2> parts, PedalParts pedals)
    : pedals_(std::move(pedals)) {
  for (const DeviceRole role : {DeviceRole::kScope, DeviceRole::kInstrument}) {
    const std::size_t i = Index(role);
    auto hand = std::make_unique<Hand>(*this, role, std::move(parts[i]));
    hands_[i] = hand.get();
    devices_[i] = std::move(hand);
    wish_.hand[i].pose = hands_[i]->pose();
  }
}

HeldHands::~HeldHands() = default;

void HeldHands::LogTo(DeviceLog& log, DeviceRole role, int source, int hand) {
  auto& device = devices_[Index(role)];
  device = std::make_unique<LoggedDevice>(std::move(device), log, source, hand);
}

Device* HeldHands::Of(DeviceRole role) noexcept { return devices_[Index(role)].get(); }

HandKind HeldHands::KindOf(DeviceRole role) const noexcept { return hands_[Index(role)]->kind(); }

// By whichever hand is read first in a tick.
void HeldHands::BeginTick(double now) noexcept {
  if (now == tick_) return;
  tick_ = now;
  if (wishes_.HasNew()) wish_ = wishes_.Read();
  if (!pedals_.device) return;
  pedal_sample_ = pedals_.device->Read(now);
  if (!IsReady(pedals_.device->state())) pedal_sample_.buttons = 0;
}

bool HeldHands::Hear(DeviceSample& sample) noexcept {
  const DeviceSample* oldest = heard_.Front();
  if (oldest == nullptr) return false;
  sample = *oldest;
  heard_.Pop();
  return true;
}

bool HeldHands::IsHeld(RigAction action) const noexcept {
  if (wish_.calibrated) return false;
  return IsDown(pedals_.buttons, action, pedal_sample_.buttons) || hands_[0]->IsHeld(action) ||
         hands_[1]->IsHeld(action);
}

void HeldHands::AfterTick(const Snapshot& snapshot, double dt) noexcept {
  for (const DeviceRole role : {DeviceRole::kScope, DeviceRole::kInstrument}) {
    const bool is_scope = role == DeviceRole::kScope;
    const ToolState& state = is_scope ? snapshot.scope : snapshot.instrument;
    HandsNews::Hand& told = told_.hand[Index(role)];
    told.felt = glm::length(state.hand_force);
    told.fault = state.fault;
    told.status = hands_[Index(role)]->status();
    if (told.status.state == DeviceState::kFault || told.status.state == DeviceState::kLost)
      told.last_fault = told.status;
    told.history.Feel(told.felt);
    told.history.Pass(dt, told.age);
  }
  const bool is_next_held = IsHeld(RigAction::kNextInstrument);
  if (is_next_held && !std::exchange(was_next_held_, is_next_held)) ++told_.next_presses;
  was_next_held_ = is_next_held;
  told_.peak_force = std::max(told_.peak_force, glm::length(snapshot.instrument.tip_force));
  if (snapshot.instrument.is_running) told_.running += dt;
  news_.Write(told_);
}

}  // namespace arthro::simulation
