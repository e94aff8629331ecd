// The driver of a session: reads both devices, ticks the session, commands the forces and steps the
// tissue [method.md, Output chain; method.md, Threads]. The window, `replay`, `demo` and the
// benchmarks all run a session through it.
//
// Start runs it on a thread: 1 kHz, or 250 Hz where no device has force, on an absolute clock.
// Missed ticks are left out and the next tick covers the time of both. While the thread runs it
// owns the session. Requests, snapshots and reports pass through newest-value slots. However it
// ends, the last command to each device is no force.
//
// TickOnce runs it on the caller's clock. A tick is noexcept, locks nothing and allocates nothing,
// except that a session with TissuePace::kInline steps its tissue within the tick.
//
// In zero-force mode the force on the hand is computed, shown and scored, and no device is given
// any. SI units.
#pragma once

#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "simulation/core/latest_value.h"
#include "simulation/device/device.h"
#include "simulation/practice/session.h"
#include "simulation/practice/time_histogram.h"

namespace arthro::simulation {

// Observer of each tick, on the thread of the servo: noexcept, no waiting, no allocation.
class ServoWatch {
 public:
  virtual ~ServoWatch() = default;
  virtual void AfterTick(const Snapshot& snapshot, double dt) noexcept = 0;
};

inline constexpr double kServoPeriod = 0.001;  // s

struct ServoOptions {
  double period = kServoPeriod;
  double period_without_force = 0.004;  // s; stability sets no limit without force
  int overrun_ticks = 3;                // a tick that is later than this gives no force
  bool wants_priority = true;
  std::uint32_t dead_man_buttons = 2;  // bit field; the first button of a handle closes the jaws
  // s; a window without a newer request may hang, so no dead-man counts any more.
  double request_lasts = std::numeric_limits<double>::infinity();
  std::vector<ServoWatch*> watches = {};  // called in this order; they must outlive the loop
};

// State that the window requests of the session and the devices.
struct ServoRequest {
  SessionOptions options;  // before the limits of the devices are applied
  double incision_spacing = 0, view_angle = 0;
  CameraHead head;
  Disturbances disturbances;
  ToolKind instrument = ToolKind::kProbe;
  std::array<bool, 2> is_dead_man_held{};  // indexed by DeviceRole; by a key or a pedal
  bool is_zero_force = false;
  std::array<std::optional<DeviceRig>, 2> mount{};  // indexed by DeviceRole; nullopt: unchanged
};

struct ServoReport {
  bool has_priority = true;  // SCHED_FIFO was granted, or there is no thread
  double period = 0;         // s, nominal
  double true_period = 0;    // s, limits the stiffness; longer than `period` where ticks come late
  long ticks = 0;
  long missed = 0;    // ticks that were left out because the one before came late
  long overruns = 0;  // ticks without force because they came late
  TimeHistogram lateness;
  TimeHistogram compute;  // s, from reading the devices to commanding them, without tissue
  std::array<TimeHistogram, 2> sample_age;  // indexed by DeviceRole
};

// Options of the session within the limits of its devices.
struct OptionsInForce {
  SessionOptions options;
  double since = 0;  // s, just before the first tick with them
};

// A sentence for the user about missing priority; empty where there is none to report.
std::string DescribeTrouble(const ServoReport& report);

class ServoLoop {
 public:
  // A null device is absent. All three must outlive the loop, and nothing else may tick the session
  // or call the devices meanwhile.
  ServoLoop(Session& session, Device* scope, Device* instrument, const ServoOptions& options = {});
  ~ServoLoop();  // calls Stop
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  void Start();  // starts the thread, on the steady clock
  void Stop();   // waits for the running tick, then commands no force
  // Ticks at `now`, which must rise, on the clock of the samples; not while the thread runs. `dt`
  // is the time since the last tick.
  void TickOnce(double now) noexcept;
  void TickOnce(double now, double dt) noexcept;

  // Callable from one other thread.
  void SetRequest(const ServoRequest& request) noexcept { requests_.Write(request); }
  const Snapshot& ReadSnapshot() noexcept { return snapshots_.Read(); }
  const ServoReport& ReadReport() noexcept { return reports_.Read(); }
  const OptionsInForce& ReadOptions() noexcept { return in_force_.Read(); }

  // Adds and removes a watch, which must outlive the loop or be removed; not while the thread runs.
  void AddWatch(ServoWatch* watch) { options_.watches.push_back(watch); }
  void RemoveWatch(ServoWatch* watch) { std::erase(options_.watches, watch); }

  double period() const noexcept { return period_; }

 private:
  void Run() noexcept;
  void TakeRequest(double now) noexcept;
  void ApplyOptions(double now) noexcept;
  DeviceSample ReadDevice(DeviceRole role, double now, HandPush push) noexcept;
  void CommandDevice(DeviceRole role, const glm::dvec3& force_in_portal) noexcept;
  void CommandNothing() noexcept;

  Session& session_;
  std::array<Device*, 2> devices_;
  ServoOptions options_;
  double period_;
  ServoRequest request_;
  double requested_at_ = -std::numeric_limits<double>::infinity();
  bool is_watched_ = false, was_zero_force_ = false;
  std::optional<double> last_;  // s, time of the last tick
  ServoReport report_;
  LatestValue<ServoRequest> requests_;
  LatestValue<Snapshot> snapshots_;
  LatestValue<ServoReport> reports_;
  LatestValue<OptionsInForce> in_force_;
  std::atomic<bool> stop_{false};
  std::thread thread_;  // last member: it uses the others
};

}  // namespace arthro::simulation
