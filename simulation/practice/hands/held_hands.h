// Both hands of a practice as its servo sees them. A hand is held by a device where one reports its
// position, and otherwise by mouse and keys. Devices are those of a rig, a recording, or simulated
// devices that mouse and keys lead. Buttons of a rig are translated here to those of the session:
// bit 0 closes the jaws, bit 1 is the dead-man. Device frame, m, N, s.
// The servo calls the devices and AfterTick; one other thread, the window, writes requests and
// reads reports.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "simulation/core/bounded_queue.h"
#include "simulation/core/latest_value.h"
#include "simulation/device/live/live_device.h"
#include "simulation/device/log/logged_device.h"
#include "simulation/device/plant_device.h"
#include "simulation/device/recorded_device.h"
#include "simulation/practice/hands/force_history.h"
#include "simulation/practice/hands/why_no_force.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/practice/servo_loop.h"
#include "simulation/scene/json/rig_file.h"

namespace arthro::simulation {

struct HandParts {
  HandKind kind = HandKind::kMouse;
  ScriptedDevice by_mouse;
  std::unique_ptr<Device> device;  // kSimulated and kPluggedIn
  HandPlant* led = nullptr;        // kSimulated: the plant inside `device`
  // The same as `device` where it senses rates: its hand is integrated from that of mouse and keys.
  LiveDevice* integrates = nullptr;
  std::unique_ptr<RecordedDevice> recorded;  // kRecorded
  double recording_begins = 0;               // s
  RigButtons buttons = kNoButtons;
};

struct PedalParts {
  std::unique_ptr<Device> device;  // null: no pedals
  RigButtons buttons = kNoButtons;
};

// Input from the window, once per frame.
struct HandsRequest {
  struct Hand {
    RodPose pose;               // pose to which mouse and keys lead the hand
    int episode = 0;            // HandsReport::Hand::episode that `pose` continues
    std::uint32_t buttons = 0;  // bit field, buttons of the session
    // New mount of the device; nullopt: unchanged. Simulated devices ignore it, since their rod
    // goes through the true incision.
    std::optional<DeviceRig> mount;
  };
  std::array<Hand, 2> hand;  // indexed by DeviceRole
  // Hand whose incision is being calibrated. Its samples are then queued for ReadSample, no device
  // is armed or given a force, and buttons have no other effect.
  std::optional<DeviceRole> calibrated;
  double until = 0;  // s, when the hand arrives at `pose`, at constant speed
};

// Output to the window, from the newest tick.
struct HandsReport {
  struct Hand {
    bool is_led_by_device = false;  // false: mouse and keys hold it
    // Increases when a device stops reporting the hand. The hand then stays where it is until a
    // request continues from there.
    int episode = 0;
    DeviceStatus status;
    DeviceStatus last_fault;  // kAbsent: none so far
    Fault fault = Fault::kNoSample;
    bool is_dead_man_held = false;
    double age = 0;    // s, age of the sample
    double felt = 0;   // N, force on the hand that the session computed
    double given = 0;  // N, force that the device was commanded
    ForceHistory history;
  };
  std::array<Hand, 2> hand;  // indexed by DeviceRole
  double peak_force = 0;     // N, largest on the instrument's tip so far
  double running = 0;        // s, running time of the shaver
  int next_presses = 0;      // presses of the button for the next instrument
};

class HeldHands final : public ServoWatch {
 public:
  HeldHands(std::array<HandParts, 2> parts, PedalParts pedals);
  ~HeldHands() override;
  // Logs the samples and commands of this hand, as `source` and `hand` of the log. Call before the
  // servo begins.
  void LogTo(DeviceLog& log, DeviceRole role, int source, int hand);

  Device* Of(DeviceRole role) noexcept;
  HandKind KindOf(DeviceRole role) const noexcept;  // constant
  void AfterTick(const Snapshot& snapshot, double dt) noexcept override;

  void SetRequest(const HandsRequest& request) noexcept { requests_.Write(request); }
  const HandsReport& ReadReport() noexcept { return reports_.Read(); }
  // Takes the oldest queued sample of the hand that is being calibrated; it is not valid where the
  // device gave none. Returns false when the queue is empty. The queue holds two seconds.
  bool ReadSample(DeviceSample& sample) noexcept;

 private:
  class Hand;
  void BeginTick(double now) noexcept;
  bool IsHeld(RigAction action) const noexcept;

  std::array<std::unique_ptr<Device>, 2>
      devices_;                   // indexed by DeviceRole; the hands, logged or not
  std::array<Hand*, 2> hands_{};  // inside them
  PedalParts pedals_;
  DeviceSample pedal_sample_;
  double tick_ = -1;  // s, time of the newest tick
  bool was_next_held_ = false;
  HandsRequest request_;
  HandsReport report_;
  LatestValue<HandsRequest> requests_;
  LatestValue<HandsReport> reports_;
  BoundedQueue<DeviceSample> samples_{2000};
};

}  // namespace arthro::simulation
