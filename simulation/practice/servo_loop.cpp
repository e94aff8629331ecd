#include "simulation/practice/servo_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/crash_stack.h"
#include "simulation/practice/device_options.h"

namespace arthro::simulation {
namespace {

// Interval at which the report is published and the stiffness limit is updated.
constexpr double kReportEvery = 0.1;  // s

// Lateness that is assumed without priority until it was measured: under load, one tick in fifty
// comes a whole period late [method.md, Threads].
constexpr double kUnknownLateness = 1.0;  // periods
constexpr long kKnownAfter = 1000;        // ticks

constexpr int kPriority = 80;  // above drawing and reading threads, below those of the system

// Zero forces at the end; several, since a report may be lost.
constexpr int kLastZeros = 5;

constexpr double kRounding = 1e-3;  // periods, error of a difference of two clock times

double SteadyNow() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void SleepUntil(double t) noexcept {
  using Clock = std::chrono::steady_clock;
  std::this_thread::sleep_until(Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(t))));
}

bool TakePriority() noexcept {
  // The default timer slack is 50 µs.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace

std::string DescribeTrouble(const ServoReport& report) {
  if (report.has_priority) return {};
  return fmt::format(
      "The system gives the force loop no priority (SCHED_FIFO): stiffness is limited as for "
      "{:.1f} "
      "ms instead of {:.1f}; allow rtprio 80 in limits.conf.",
      1e3 * report.true_period, 1e3 * report.period);
}

ServoLoop::ServoLoop(Session& session, Device* scope, Device* instrument,
                     const ServoOptions& options)
    : session_(session), devices_{scope, instrument}, options_(options) {
  const bool has_force = std::ranges::any_of(
      devices_, [](const Device* device) { return device != nullptr && HasForce(device->caps()); });
  period_ = has_force ? options.period : options.period_without_force;
  report_.period = report_.true_period = period_;
  request_ = {session.options(),
              session.incision_spacing(),
              session.view_angle(),
              session.camera_head(),
              session.disturbances(),
              session.instrument(),
              {},
              false,
              {}};
  ApplyOptions(0.0);
  for (const DeviceRole role : kDeviceRoles)
    if (const Device* device = devices_[Index(role)])
      session.SetFreshFor(role, FreshFor(device->caps(), period_));
  snapshots_.Write(session.snapshot());  // valid until the first tick
}

ServoLoop::~ServoLoop() { Stop(); }

void ServoLoop::Start() {
  if (thread_.joinable()) return;
  stop_ = false;
  thread_ = std::thread([this] { Run(); });
}

void ServoLoop::Stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  CommandNothing();
  reports_.Write(report_);
}

void ServoLoop::Run() noexcept {
  const CrashStack crash_stack;
  report_.has_priority = options_.wants_priority && TakePriority();
  double due = SteadyNow();
  ApplyOptions(due);
  while (!stop_.load(std::memory_order_relaxed)) {
    const double now = SteadyNow();
    report_.lateness.Add(now - due);
    TickOnce(now);
    // Waits for the next tick that is still to come.
    due += period_ * (1.0 + std::max(0.0, std::floor((SteadyNow() - due) / period_)));
    SleepUntil(due);
  }
  CommandNothing();
}

// Without priority, the delay of the rendered spring grows by the 99th percentile of the lateness.
void ServoLoop::ApplyOptions(double now) noexcept {
  if (!report_.has_priority) {
    const double late = report_.lateness.count() < kKnownAfter ? kUnknownLateness * period_
                                                               : report_.lateness.Quantile(0.99);
    report_.true_period = period_ + late;
  }
  SessionOptions options = request_.options;
  bool has_force = false;
  for (const Device* device : devices_) {
    if (device == nullptr) continue;
    options = OptionsFor(device->caps(), period_, options);
    has_force = has_force || HasForce(device->caps());
  }
  if (has_force) options.lever.max_stiffness *= period_ / report_.true_period;
  session_.SetOptions(options);
  in_force_.Write({options, now - 0.5 * period_});
}

void ServoLoop::TakeRequest(double now) noexcept {
  is_watched_ = now - requested_at_ <= options_.request_lasts;
  if (!requests_.HasNew()) return;
  is_watched_ = true;
  requested_at_ = now;
  request_ = requests_.Read();
  ApplyOptions(now);
  session_.SetIncisionSpacing(request_.incision_spacing);
  session_.SetViewAngle(request_.view_angle);
  session_.SetCameraHead(request_.head);
  session_.SetDisturbances(request_.disturbances);
  session_.SetInstrument(request_.instrument);
  for (const DeviceRole role : kDeviceRoles)
    if (const auto& mount = request_.mount[Index(role)]) session_.SetMount(role, *mount);
}

DeviceSample ServoLoop::ReadDevice(DeviceRole role, double now, HandPush push) noexcept {
  Device* device = devices_[Index(role)];
  if (device == nullptr) return {};
  const DeviceSample sample = device->Read(now);
  const bool is_held = request_.is_dead_man_held[Index(role)] ||
                       (sample.valid && (sample.buttons & options_.dead_man_buttons) != 0);
  // A dead-man that does not count is not released either: a device that waits for its release
  // goes on waiting, and is given no force until then.
  device->HoldDeadMan(is_watched_ ? is_held : device->status().must_release);
  if (sample.valid) report_.sample_age[Index(role)].Add(now - sample.t);
  // A device without force, and any device in zero-force mode, needs no arming. The first tick
  // after that mode counts as not armed, so that the force ramps up.
  const bool is_armed = device->caps().feedback == Feedback::kNone || request_.is_zero_force ||
                        (device->state() == DeviceState::kArmed && !was_zero_force_);
  session_.SetPush(role, is_armed ? push : HandPush::kNo);
  return sample;
}

void ServoLoop::CommandDevice(DeviceRole role, const glm::dvec3& force_in_portal) noexcept {
  Device* device = devices_[Index(role)];
  if (device == nullptr) return;
  const DeviceRig& rig =
      role == DeviceRole::kScope ? session_.scope_rig() : session_.instrument_rig();
  device->Command(request_.is_zero_force
                      ? glm::dvec3(0.0)
                      : glm::conjugate(rig.portal_from_device) * force_in_portal);
}

void ServoLoop::CommandNothing() noexcept {
  for (int i = 0; i < kLastZeros; ++i)
    for (const DeviceRole role : kDeviceRoles) CommandDevice(role, glm::dvec3(0.0));
}

void ServoLoop::TickOnce(double now) noexcept { TickOnce(now, last_ ? now - *last_ : period_); }

void ServoLoop::TickOnce(double now, double dt) noexcept {
  const double begin = SteadyNow();
  last_ = now;
  TakeRequest(now);
  // After an overrun the device held an outdated force, so this tick gives none.
  const double late = dt / period_ - 1.0;
  HandPush push = HandPush::kYes;
  if (late > options_.overrun_ticks + kRounding) {
    push = HandPush::kPause;
    ++report_.overruns;
  }
  report_.missed += std::max(0L, std::lround(late));
  ++report_.ticks;

  const DeviceSample scope = ReadDevice(DeviceRole::kScope, now, push);
  const DeviceSample instrument = ReadDevice(DeviceRole::kInstrument, now, push);
  session_.Tick(scope, instrument, dt);
  CommandDevice(DeviceRole::kScope, session_.snapshot().scope.hand_force);
  CommandDevice(DeviceRole::kInstrument, session_.snapshot().instrument.hand_force);
  report_.compute.Add(SteadyNow() - begin);
  session_.TickTissues(dt);
  was_zero_force_ = request_.is_zero_force;
  snapshots_.Write(session_.snapshot());
  for (ServoWatch* watch : options_.watches) watch->AfterTick(session_.snapshot(), dt);

  if (report_.ticks % std::max(1L, std::lround(kReportEvery / period_)) != 0) return;
  if (!report_.has_priority) ApplyOptions(now);
  reports_.Write(report_);
}

}  // namespace arthro::simulation
