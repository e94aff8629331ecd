// What holds the two hands of a practice, as a person chose (hands_choice.h). It finds and keeps
// the devices, makes the hands of each practice (held_hands.h), and says how they fare. The servo
// of a practice alone reads and commands the devices; while none runs their links are looked at
// here. SI. All of it is called by the window's thread.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/device/live/live_device.h"
#include "simulation/device/live/release_on_crash.h"
#include "simulation/device/openhaptics/openhaptics_devices.h"
#include "simulation/practice/hands/hands_choice.h"
#include "simulation/practice/hands/held_hands.h"
#include "simulation/practice/hands/why_no_force.h"
#include "simulation/practice/session_options.h"

namespace arthro::simulation {

// How a hand stands now, for panels.
struct HandNow {
  HandKind kind = HandKind::kMouse;
  std::string name, serial;       // of its device
  std::string sentence;           // its state
  std::string last_fault;         // empty: none since the practice began
  ForceSituation situation;       // for WhyNoForce
  double felt = 0, given = 0;     // N: what the session has for the hand, and what the device gets
  double peak = 0;                // N, the device's
  double sample_age = 0;          // s
  bool is_led_by_device = false;  // or else mouse and keys hold it
};

class Hands {
 public:
  // `bus` null: this machine's, asked for only where the rig needs it. Throws Error where the log
  // cannot be written.
  explicit Hands(HandsChoice choice = {}, std::unique_ptr<HidBus> bus = {},
                 const LiveOptions& options = {});
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  // The rig's mounts take the scene's place, and what it allows lowers what is felt.
  void Mount(Scene& scene) const;
  void Lower(SessionOptions& options) const noexcept;

  // Where this hand's incision is: of the rig, or as it was calibrated since, or the scene's.
  DeviceRig MountOf(DeviceRole role, const Scene& scene) const;

  // The hands of a practice that begins, by DeviceRole, where mouse and keys have them. This must
  // outlive them. Shared only so that it is known here when they are gone.
  std::shared_ptr<HeldHands> Hold(const std::array<ScriptedDevice, 2>& by_mouse);
  // What is plugged in keeps its own time: its practice needs a servo with a thread.
  bool NeedsThread() const noexcept { return HasDevices(); }
  double Clock() const noexcept { return options_.clock(); }

  // Once a frame. True where a panel has news.
  bool Look();

  void HoldDeadMan(bool is_held) noexcept { is_key_held_ = is_held; }
  bool is_dead_man_held() const noexcept { return is_key_held_; }
  bool is_zero_force() const noexcept { return is_zero_force_; }
  void SetZeroForce(bool is_on) noexcept { is_zero_force_ = is_on; }

  bool HasDevices() const noexcept { return !links_.empty() || openhaptics_ != nullptr; }
  // Whether a device, and not mouse or keys, said where this hand is in the newest tick.
  bool Leads(DeviceRole role) const;
  HandNow Now(DeviceRole role) const;
  ForceHistory History(DeviceRole role) const;
  // What a person must know when a rig's device does not hold its hand; empty: all is well.
  std::string Missing(DeviceRole role) const;
  // Its handle is in its rest: counts from here.
  void AskHome(DeviceRole role);

  // The incision of this hand is being calibrated, in the practice that runs: no device is given a
  // force meanwhile, and what the hand's device says is heard, the oldest first.
  void Calibrate(std::optional<DeviceRole> role);
  const std::optional<DeviceRole>& calibrated() const noexcept { return calibrated_; }
  bool Hear(DeviceSample& sample);
  // What will hold this hand once a practice runs.
  HandKind KindOf(DeviceRole role) const;
  // A sentence where this hand has no incision to calibrate; empty: it has one.
  std::string WhyNotCalibrated(DeviceRole role) const;
  // It was found there, from the next Mount on.
  void SetPivot(DeviceRole role, const glm::dvec3& pivot_in_device);
  // Whether the rig's file has a place for this hand's pivot.
  bool IsInRig(DeviceRole role) const noexcept { return RigOf(role).has_value(); }
  const std::filesystem::path& rig_file() const noexcept { return choice_.rig_file; }
  // The rig with the pivots that were found; `file` is its own from then on. Throws Error.
  void SaveRig(const std::filesystem::path& file);

  // No practice runs and none will: lets go of the devices and ends the log. A sentence where
  // something is missing in that; empty: all is well. Throws Error(kFile).
  std::string End();

 private:
  struct Link {
    DeviceWish wish;
    std::shared_ptr<LiveLink> link;
  };
  struct Role {
    std::shared_ptr<LiveLink> link;     // where it is a HID …
    std::optional<std::size_t> number;  // … or which of openhaptics_
    // For what never changes of it; null: the rig names none.
    std::unique_ptr<Device> device;
    DeviceStatus status;  // while no practice runs
  };
  // Of a log: which source a role's hand is there, and which hand of that.
  struct Logged {
    int source = 0, hand = 0;
  };
  void OpenLog();
  void OpenRig();
  std::shared_ptr<LiveLink> LinkOf(const RigDevice& device);
  const std::optional<RigRole>& RigOf(DeviceRole role) const noexcept;
  // Of those whose device holds their hand: nothing stands in for it.
  const std::optional<RigRole>& DrivenOf(DeviceRole role) const noexcept;
  const Role& Of(DeviceRole role) const noexcept { return roles_[static_cast<std::size_t>(role)]; }
  std::unique_ptr<Device> DeviceOf(DeviceRole role);
  DeviceStatus StatusOf(DeviceRole role) const;
  std::string DetailOf(DeviceRole role) const;

  HandsChoice choice_;
  LiveOptions options_;
  std::unique_ptr<HidBus> bus_;  // outlives the links, as the next three do
  std::unique_ptr<DeviceLog> log_;
  std::vector<std::unique_ptr<LoggedReports>> taps_;  // one a link, where there is a log
  std::array<Logged, 2> logged_{};                    // by DeviceRole
  std::array<bool, 2> is_recorded_{};                 // by DeviceRole
  std::vector<Link> links_;
  std::shared_ptr<OpenHapticsDevices> openhaptics_;  // null: the rig names none
  std::optional<ReleaseOnCrash> crash_;
  std::array<Role, 2> roles_;  // by DeviceRole
  std::shared_ptr<LiveLink> pedals_;
  std::weak_ptr<HeldHands> held_;
  std::optional<DeviceRole> calibrated_;
  std::array<std::optional<glm::dvec3>, 2> pivots_;  // by DeviceRole; that were found since
  bool is_key_held_ = false, is_zero_force_ = false;
};

}  // namespace arthro::simulation
