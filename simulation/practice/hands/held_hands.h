// Both hands of a practice as its servo sees them. Each is held by a device where one says where it
// is, and by mouse and keys where none does: a rig's device, a recording, a simulated device that
// mouse and keys lead. What a rig binds to a button is translated here to the session's own: bit 0
// closes the jaws, bit 1 is the dead-man. Device frame, m, N, s.
// The servo calls the devices, and AfterTick; one other thread, the window, wishes and reads news.
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
#include "simulation/scene/rig_file.h"

namespace arthro::simulation {

struct HandParts {
  HandKind kind = HandKind::kMouse;
  ScriptedDevice by_mouse;
  std::unique_ptr<Device> device;  // of kSimulated and kPluggedIn
  HandPlant* led = nullptr;        // of kSimulated, inside `device`
  // Inside `device`: it integrates its hand, from where mouse and keys have it.
  LiveDevice* integrates = nullptr;
  std::optional<RecordedDevice> recorded;  // of kRecorded
  double recording_begins = 0;             // s
  RigButtons buttons = kNoButtons;
};

struct PedalParts {
  std::unique_ptr<Device> device;  // null: none
  RigButtons buttons = kNoButtons;
};

// From the window, once a frame.
struct HandsWish {
  struct Hand {
    RodPose pose;               // where mouse and keys want it
    int episode = 0;            // of the news that this pose goes on from
    std::uint32_t buttons = 0;  // of the session
    // Where its device's incision is from now on; none: as it was, as it is for ever of a simulated
    // device, whose rod goes through the true one.
    std::optional<DeviceRig> mount;
  };
  std::array<Hand, 2> hand;  // by DeviceRole
  // Its incision is calibrated: what its device says is heard, no device is given a force or armed,
  // and buttons do nothing else.
  std::optional<DeviceRole> calibrated;
  double until = 0;  // s, by when it is to be there; evenly until then
};

// To the window, of the newest tick.
struct HandsNews {
  struct Hand {
    bool is_led_by_device = false;  // or else mouse and keys hold it
    // Grows when a device lets go of it: then it stands where it is until the window goes on from
    // there.
    int episode = 0;
    DeviceStatus status;
    DeviceStatus last_fault;  // kAbsent: there was none
    Fault fault = Fault::kNoSample;
    bool is_dead_man_held = false;
    double age = 0;              // s, of its sample
    double felt = 0, given = 0;  // N: what the session has for it, and what its device gets
    ForceHistory history;
  };
  std::array<Hand, 2> hand;  // by DeviceRole
  double peak_force = 0;     // N, largest on the instrument's tip so far
  double running = 0;        // s, that the shaver ran
  int next_presses = 0;      // of what a rig binds to the next instrument
};

class HeldHands final : public ServoWatch {
 public:
  HeldHands(std::array<HandParts, 2> parts, PedalParts pedals);
  ~HeldHands() override;
  // Before the servo begins. What it sees of this hand, and what it commands, goes there: `source`
  // and `hand` of the log's.
  void LogTo(DeviceLog& log, DeviceRole role, int source, int hand);

  Device* Of(DeviceRole role) noexcept;
  HandKind KindOf(DeviceRole role) const noexcept;  // never changes
  void AfterTick(const Snapshot& snapshot, double dt) noexcept override;

  void Wish(const HandsWish& wish) noexcept { wishes_.Write(wish); }
  const HandsNews& News() noexcept { return news_.Read(); }
  // While one is calibrated: what its device said, the oldest first, not valid where it said
  // nothing. False: that was all. Two seconds are kept.
  bool Hear(DeviceSample& sample) noexcept;

 private:
  class Hand;
  void BeginTick(double now) noexcept;
  bool IsHeld(RigAction action) const noexcept;

  std::array<std::unique_ptr<Device>, 2> devices_;  // by DeviceRole; the hands, or logged
  std::array<Hand*, 2> hands_{};                    // inside them
  PedalParts pedals_;
  DeviceSample pedal_sample_;
  double tick_ = -1;  // the tick that began last
  bool was_next_held_ = false;
  HandsWish wish_;
  HandsNews told_;
  LatestValue<HandsWish> wishes_;
  LatestValue<HandsNews> news_;
  BoundedQueue<DeviceSample> heard_{2000};
};

}  // namespace arthro::simulation
