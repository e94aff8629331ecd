// The servo: reads both devices, ticks the session, commands their forces, at 1 kHz on a thread of
// its own, 250 Hz where no device has force [method.md, Output chain; method.md, Threads]. Its
// clock is absolute: ticks that were missed are left out, and the next one is told the true time.
// While it runs the session is its own; what somebody wishes and what came of it go through newest
// values. However it ends, the last thing that a device hears is no force. In zero-force mode what
// a hand would feel is computed, shown and scored, and no device is given any.
// Time is an argument of TickOnce, so that a test drives it by hand. s; a tick is noexcept, locks
// nothing, allocates nothing.
#pragma once

#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include "simulation/core/latest_value.h"
#include "simulation/device/device.h"
#include "simulation/practice/session.h"
#include "simulation/practice/time_histogram.h"

namespace arthro::simulation {

// Who wants to know of each tick. On the servo's thread: noexcept, no waiting, no allocation.
class ServoWatch {
 public:
  virtual ~ServoWatch() = default;
  virtual void AfterTick(const Snapshot& snapshot, double dt) noexcept = 0;
};

struct ServoOptions {
  double period = 0.001;
  double period_without_force = 0.004;  // nothing swings: a picture's rate and more will do
  int overrun_ticks = 3;                // later than so many: no force in that tick
  bool wants_priority = true;
  // Which buttons of a handle are its dead-man: the second; the first closes the jaws.
  std::uint32_t dead_man_buttons = 2;
  // s; somebody who wished nothing for longer hangs or is busy: then no dead-man counts.
  double wish_lasts = std::numeric_limits<double>::infinity();
  ServoWatch* watch = nullptr;  // outlives the loop
};

// What somebody wishes of a session that a servo ticks.
struct ServoWish {
  SessionOptions options;  // before the devices lower them
  double incision_spacing = 0, view_angle = 0;
  ToolKind instrument = ToolKind::kProbe;
  std::array<bool, 2> is_dead_man_held{};  // by key or pedal, by DeviceRole
  bool is_zero_force = false;
  std::array<std::optional<DeviceRig>, 2> mount{};  // by DeviceRole; none: as it is
};

struct ServoReport {
  bool has_priority = true;  // of the thread, where there is one
  double period = 0;         // that it should have
  double true_period = 0;    // that stiffness is limited by: longer where ticks come late
  long ticks = 0;
  long missed = 0;    // left out, since the one before came late
  long overruns = 0;  // ticks without force for that
  TimeHistogram lateness, compute;
  std::array<TimeHistogram, 2> sample_age;  // by DeviceRole
};
// A sentence for a person about what went less than well; empty: nothing.
std::string SentenceOf(const ServoReport& report);

class ServoLoop {
 public:
  // A device that is null is not there. All three outlive the loop; nobody else touches the
  // session's ticks or the devices meanwhile.
  ServoLoop(Session& session, Device* scope, Device* instrument, const ServoOptions& options = {});
  ~ServoLoop();  // as Stop
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  void Start();  // the thread; its clock is the steady one
  void Stop();   // waits for the tick that runs; no force after it
  // A tick at `now`, which rises, on the clock of the devices' samples; not beside the thread.
  void TickOnce(double now) noexcept;

  // One other thread's side.
  void Wish(const ServoWish& wish) noexcept { wishes_.Write(wish); }
  const Snapshot& Read() noexcept { return snapshots_.Read(); }
  const ServoReport& ReadReport() noexcept { return reports_.Read(); }

  double period() const noexcept { return period_; }

 private:
  void Run() noexcept;
  void TakeWish(double now) noexcept;
  void ApplyOptions() noexcept;
  DeviceSample ReadDevice(DeviceRole role, double now, HandPush push) noexcept;
  void CommandDevice(DeviceRole role, const glm::dvec3& force_in_portal) noexcept;
  void CommandNothing() noexcept;

  Session& session_;
  std::array<Device*, 2> devices_;
  ServoOptions options_;
  double period_;
  ServoWish wish_;
  double wished_at_ = -std::numeric_limits<double>::infinity();
  bool is_watched_ = false, was_zero_force_ = false;
  std::optional<double> last_;  // tick
  ServoReport report_;
  LatestValue<ServoWish> wishes_;
  LatestValue<Snapshot> snapshots_;
  LatestValue<ServoReport> reports_;
  std::atomic<bool> stop_{false};
  std::thread thread_;  // last: it uses the rest
};

}  // namespace arthro::simulation
