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

constexpr std::array kRoles{DeviceRole::kScope, DeviceRole::kInstrument};

constexpr std::size_t Index(DeviceRole role) noexcept { return static_cast<std::size_t>(role); }

// A picture's rate is enough for a report, and for what stiffness a late servo may show.
constexpr double kReportEvery = 0.1;  // s

// Without priority, until it is known how late this machine is: a tick in fifty comes a whole one
// late under load [method.md, Threads].
constexpr double kUnknownLateness = 1.0;  // periods
constexpr long kKnownAfter = 1000;        // ticks

constexpr int kPriority = 80;  // above what draws and reads, below what the system keeps for itself

// As devices do when they close: a report may be lost.
constexpr int kLastZeros = 5;

constexpr double kRounding = 1e-3;  // periods, of a difference of two clock times

double SteadyNow() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void SleepUntil(double t) noexcept {
  using Clock = std::chrono::steady_clock;
  std::this_thread::sleep_until(Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(t))));
}

bool TakePriority() noexcept {
  // Without it timers are as coarse as 50 µs.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace

std::string SentenceOf(const ServoReport& report) {
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
  wish_ = {session.options(),
           session.incision_spacing(),
           session.view_angle(),
           session.instrument(),
           {},
           false,
           {}};
  ApplyOptions();
  for (const DeviceRole role : kRoles)
    if (const Device* device = devices_[Index(role)])
      session.SetFreshFor(role, FreshFor(device->caps(), period_));
  snapshots_.Write(session.snapshot());  // until the first tick
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
  ApplyOptions();
  double due = SteadyNow();
  while (!stop_.load(std::memory_order_relaxed)) {
    const double now = SteadyNow();
    report_.lateness.Add(now - due);
    TickOnce(now);
    const double end = SteadyNow();
    report_.compute.Add(end - now);
    // The next one that has not gone by.
    due += period_ * (1.0 + std::max(0.0, std::floor((end - due) / period_)));
    SleepUntil(due);
  }
  CommandNothing();
}

// Where there is no priority a spring is as late as the ticks are, at their 99th percentile.
void ServoLoop::ApplyOptions() noexcept {
  if (!report_.has_priority) {
    const double late = report_.lateness.count() < kKnownAfter ? kUnknownLateness * period_
                                                               : report_.lateness.Quantile(0.99);
    report_.true_period = period_ + late;
  }
  SessionOptions options = wish_.options;
  bool has_force = false;
  for (const Device* device : devices_) {
    if (device == nullptr) continue;
    options = OptionsFor(device->caps(), period_, options);
    has_force = has_force || HasForce(device->caps());
  }
  if (has_force) options.lever.max_stiffness *= period_ / report_.true_period;
  session_.SetOptions(options);
}

void ServoLoop::TakeWish(double now) noexcept {
  is_watched_ = now - wished_at_ <= options_.wish_lasts;
  if (!wishes_.HasNew()) return;
  is_watched_ = true;
  wished_at_ = now;
  wish_ = wishes_.Read();
  ApplyOptions();
  session_.SetIncisionSpacing(wish_.incision_spacing);
  session_.SetViewAngle(wish_.view_angle);
  session_.SetInstrument(wish_.instrument);
  for (const DeviceRole role : kRoles)
    if (const auto& mount = wish_.mount[Index(role)]) session_.SetMount(role, *mount);
}

DeviceSample ServoLoop::ReadDevice(DeviceRole role, double now, HandPush push) noexcept {
  Device* device = devices_[Index(role)];
  if (device == nullptr) return {};
  const DeviceSample sample = device->Read(now);
  device->HoldDeadMan(is_watched_ &&
                      (wish_.is_dead_man_held[Index(role)] ||
                       (sample.valid && (sample.buttons & options_.dead_man_buttons) != 0)));
  if (sample.valid) report_.sample_age[Index(role)].Add(now - sample.t);
  // One that shows no force has nothing to arm, and one that is given none need not be. When that
  // ends a hand is pushed gently at first.
  const bool is_armed = device->caps().feedback == Feedback::kNone || wish_.is_zero_force ||
                        (device->state() == DeviceState::kArmed && !was_zero_force_);
  session_.SetPush(role, is_armed ? push : HandPush::kNo);
  return sample;
}

void ServoLoop::CommandDevice(DeviceRole role, const glm::dvec3& force_in_portal) noexcept {
  Device* device = devices_[Index(role)];
  if (device == nullptr) return;
  const DeviceRig& rig =
      role == DeviceRole::kScope ? session_.scope_rig() : session_.instrument_rig();
  device->Command(wish_.is_zero_force ? glm::dvec3(0.0)
                                      : glm::conjugate(rig.portal_from_device) * force_in_portal);
}

void ServoLoop::CommandNothing() noexcept {
  for (int i = 0; i < kLastZeros; ++i)
    for (const DeviceRole role : kRoles) CommandDevice(role, glm::dvec3(0.0));
}

void ServoLoop::TickOnce(double now) noexcept {
  const double dt = last_ ? now - *last_ : period_;
  last_ = now;
  TakeWish(now);
  // A hand that was pushed all that time with what was right before it is let go for a tick.
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
  session_.TickTissues(dt);
  was_zero_force_ = wish_.is_zero_force;
  snapshots_.Write(session_.snapshot());
  if (options_.watch != nullptr) options_.watch->AfterTick(session_.snapshot(), dt);

  if (report_.ticks % std::max(1L, std::lround(kReportEvery / period_)) != 0) return;
  if (!report_.has_priority) ApplyOptions();
  reports_.Write(report_);
}

}  // namespace arthro::simulation
