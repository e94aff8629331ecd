// Devices that hold the two hands of a practice, as the user chose them (hands_choice.h). Finds and
// keeps the devices, makes the hands of each practice (held_hands.h) and reports their state. Only
// the servo of a practice reads and commands devices; while none runs, their links are polled here.
// SI units. Called by the window's thread only.
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
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

// State of a hand, for panels.
struct HandNow {
  HandKind kind = HandKind::kMouse;
  std::string name, serial;       // device
  std::string sentence;           // state of the device
  std::string last_fault;         // empty: none since the practice began
  ForceSituation situation;       // for WhyNoForce
  double felt = 0;                // N, force on the hand that the session computed
  double given = 0;               // N, force that the device was commanded
  double peak = 0;                // N, peak force of the device
  double sample_age = 0;          // s
  bool is_led_by_device = false;  // false: mouse and keys hold it
};

class Hands {
 public:
  // A null `bus` is that of this machine, opened only where the rig needs it. Throws Error where
  // the log cannot be written.
  explicit Hands(HandsChoice choice = {}, std::unique_ptr<HidBus> bus = {},
                 const LiveOptions& options = {});
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  // Replaces the mounts of the scene by those of the rig.
  void Mount(Scene& scene) const;
  // Lowers the limits of force and stiffness to those of the rig.
  void LowerLimits(SessionOptions& options) const noexcept;

  // Mount of this hand: calibrated since the start, else of the rig, else of the scene.
  DeviceRig MountOf(DeviceRole role, const Scene& scene) const;

  // How far the tip of an instrument lies beyond the end of the rod of the rig, m.
  double TipBeyondRod(ToolKind kind) const noexcept;

  // Makes the hands of a practice, at the poses of mouse and keys. This must outlive them. They are
  // shared so that this can tell when they are gone.
  std::shared_ptr<HeldHands> MakeHeldHands(const std::array<ScriptedDevice, 2>& by_mouse);
  // Plugged-in devices keep their own time, so that their practice needs a servo thread.
  bool NeedsThread() const noexcept { return HasDevices(); }
  double Clock() const noexcept { return options_.clock(); }

  // Polls the devices, once per frame. True where the state of one has changed.
  bool Look();

  void HoldDeadMan(bool is_held) noexcept { is_key_held_ = is_held; }
  bool is_dead_man_held() const noexcept { return is_key_held_; }
  bool is_zero_force() const noexcept { return is_zero_force_; }
  void SetZeroForce(bool is_on) noexcept { is_zero_force_ = is_on; }

  // Logs what the hands do not tell, where there is a log; `t` on the clock of the ticks.
  void LogWish(double t, const LoggedWish& wish) noexcept;
  void LogOption(double t, const LoggedOption& option) noexcept;

  bool HasDevices() const noexcept { return !links_.empty() || openhaptics_ != nullptr; }
  // True where a device, and not mouse and keys, held this hand in the newest tick.
  bool Leads(DeviceRole role) const;
  HandNow Now(DeviceRole role) const;
  ForceHistory History(DeviceRole role) const;
  // A sentence where a device of the rig does not hold its hand; empty where all is well.
  std::string Missing(DeviceRole role) const;
  // Homes the device: its handle is in its rest.
  void AskHome(DeviceRole role);

  // Begins calibrating the incision of this hand in the running practice, or ends it. No device is
  // given a force meanwhile, and the samples of the hand's device are queued for ReadSample.
  void Calibrate(std::optional<DeviceRole> role);
  const std::optional<DeviceRole>& calibrated() const noexcept { return calibrated_; }
  bool ReadSample(DeviceSample& sample);  // see HeldHands::ReadSample
  // Kind of hand once a practice runs.
  HandKind KindOf(DeviceRole role) const;
  // A sentence where this hand has no incision to calibrate; empty where it has one.
  std::string WhyNotCalibrated(DeviceRole role) const;
  // Sets a calibrated pivot, used from the next Mount on.
  void SetPivot(DeviceRole role, const glm::dvec3& pivot_in_device);
  // True where the rig file has an entry for this hand.
  bool IsInRig(DeviceRole role) const noexcept { return RigOf(role).has_value(); }
  const std::filesystem::path& rig_file() const noexcept { return choice_.rig_file; }
  // Writes the rig with the calibrated pivots; `file` becomes its file. Throws Error.
  void SaveRig(const std::filesystem::path& file);

  // Closes the devices and the log, when no practice runs and none will. Returns a sentence where
  // the log is incomplete, else nothing. Throws Error(kFile).
  std::string End();

 private:
  struct Link {
    DeviceRequest request;
    std::shared_ptr<LiveLink> link;
  };
  struct Role {
    std::shared_ptr<LiveLink> link;     // HID devices
    std::optional<std::size_t> number;  // index in openhaptics_, for its devices
    std::unique_ptr<Device> device;     // read for its constants; null: the rig names none
    DeviceStatus status;                // while no practice runs
  };
  // Source in the log, and index of the hand in that source.
  struct Logged {
    int source = 0, hand = 0;
  };
  void OpenLog();
  void OpenRig();
  std::shared_ptr<LiveLink> LinkOf(const RigDevice& device);
  const std::optional<RigRole>& RigOf(DeviceRole role) const noexcept;
  // Entry of the rig whose device holds the hand: no recording or simulation replaces it.
  const std::optional<RigRole>& DrivenOf(DeviceRole role) const noexcept;
  const Role& Of(DeviceRole role) const noexcept { return roles_[Index(role)]; }
  std::unique_ptr<Device> DeviceOf(DeviceRole role);
  DeviceStatus StatusOf(DeviceRole role) const;
  std::string DetailOf(DeviceRole role) const;

  HandsChoice choice_;
  LiveOptions options_;
  std::unique_ptr<HidBus> bus_;  // outlives the links, as do the next three members
  std::unique_ptr<DeviceLog> log_;
  LogChannel* wishes_ = nullptr;                      // channel of the log
  std::vector<std::unique_ptr<LoggedReports>> taps_;  // one per link, where there is a log
  std::array<Logged, 2> logged_{};                    // indexed by DeviceRole
  std::array<bool, 2> is_recorded_{};                 // indexed by DeviceRole
  std::vector<Link> links_;
  std::shared_ptr<OpenHapticsDevices> openhaptics_;  // null: the rig names no such device
  std::optional<ReleaseOnCrash> crash_;
  std::array<Role, 2> roles_;  // indexed by DeviceRole
  std::shared_ptr<LiveLink> pedals_;
  std::weak_ptr<HeldHands> held_;
  std::optional<DeviceRole> calibrated_;
  std::array<std::optional<glm::dvec3>, 2>
      pivots_;  // indexed by DeviceRole; calibrated since the start
  bool is_key_held_ = false, is_zero_force_ = false;
};

}  // namespace arthro::simulation
