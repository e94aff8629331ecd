#include "simulation/practice/first_hour/force_trial.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr int kLastZeros = 5;       // a report may be lost
constexpr double kLastShare = 0.2;  // share of the time in which the place of the hand is averaged
constexpr double kSettling = 0.5;   // s, armed without force; a hand swings back from the last push
constexpr double kSpeedTime = 0.01;  // s, low pass of the hand's speed

// Speed of the hand from new samples.
class HandSpeed {
 public:
  double Update(const DeviceSample& sample) {
    if (const double dt = sample.t - last_.t; has_last_ && dt > 0) {
      const double now = glm::distance(sample.hip_in_device, last_.hip_in_device) / dt;
      speed_ += std::min(1.0, dt / kSpeedTime) * (now - speed_);
    }
    last_ = sample;
    has_last_ = true;
    return speed_;
  }

 private:
  DeviceSample last_;
  double speed_ = 0;
  bool has_last_ = false;
};

// Waits until the device is armed. Returns true when it is; else `report.end` says why not.
bool WaitUntilArmed(Device& device, const ForceTrial& trial, const TrialTicks& ticks,
                    TrialReport& report, double& now) {
  const double begin = now = ticks.next();
  report.end = TrialEnd::kNotReady;
  while (now - begin < trial.patience) {
    if (ticks.stops()) {
      report.end = TrialEnd::kStopped;
      return false;
    }
    const DeviceSample sample = device.Read(now);
    if (device.state() == DeviceState::kArmed) return true;
    if (IsReady(device.state())) report.end = TrialEnd::kNotArmed;
    device.HoldDeadMan(ticks.is_held(sample));
    device.Command(glm::dvec3(0.0));
    now = ticks.next();
  }
  return false;
}

class ArmedTrial {
 public:
  ArmedTrial(Device& device, const ForceTrial& trial, const TrialTicks& ticks, TrialReport& report)
      : device_(device), trial_(trial), ticks_(ticks), report_(report) {}

  void Run(double now) {
    last_ = now;
    begin_ = now + kSettling;
    while (!IsOver(now)) {
      Tick(now);
      last_ = now;
      now = ticks_.next();
    }
    report_.seconds = std::max(0.0, last_ - begin_);
    if (report_.seconds > 0) report_.rate = static_cast<double>(samples_) / report_.seconds;
    if (averaged_ > 0) report_.moved = sum_ / static_cast<double>(averaged_) - from_;
  }

 private:
  bool IsOver(double now) {
    if (ticks_.stops())
      report_.end = TrialEnd::kStopped;
    else if (is_lost_)
      report_.end = TrialEnd::kLost;
    else if (was_released_)
      report_.end = TrialEnd::kReleased;
    else if (now - begin_ >= trial_.seconds)
      report_.end = TrialEnd::kDone;
    else
      return false;
    return true;
  }

  Fault FaultOf(const DeviceSample& sample, double now) const {
    if (!sample.valid) return Fault::kNoSample;
    if (now - sample.t > trial_.limiter.max_sample_age + kClockGrain) return Fault::kStale;
    return device_.state() == DeviceState::kArmed ? Fault::kNone : Fault::kNotArmed;
  }

  void Tick(double now) {
    const DeviceSample sample = device_.Read(now);
    const bool is_settled = now >= begin_;
    if (sample.valid && sample.t > newest_) {
      newest_ = sample.t;
      speed_ = hand_.Update(sample);
      if (is_settled) Take(sample, now);
    }
    is_lost_ = device_.state() == DeviceState::kLost || device_.state() == DeviceState::kFault ||
               device_.state() == DeviceState::kAbsent;
    const bool is_held = ticks_.is_held(sample);
    device_.HoldDeadMan(is_held);
    was_released_ = !is_held;
    const Fault fault = is_held ? FaultOf(sample, now) : Fault::kNotArmed;
    const double dt = std::max(now - last_, 1e-6);
    const glm::dvec3 force =
        is_settled ? LimitForce(trial_.limiter, trial_.force, speed_, fault, dt, limiter_).force
                   : glm::dvec3(0.0);
    device_.Command(force);
    Note(glm::length(force), dt, now);
  }

  void Take(const DeviceSample& sample, double now) {
    if (samples_++ == 0) from_ = sample.hip_in_device;
    report_.spread = std::max(report_.spread, glm::distance(sample.hip_in_device, from_));
    if (now - begin_ < (1 - kLastShare) * trial_.seconds) return;
    sum_ += sample.hip_in_device;
    ++averaged_;
  }

  void Note(double force, double dt, double now) {
    report_.largest = std::max(report_.largest, force);
    if (given_ > 0 || force > 0)
      report_.steepest = std::max(report_.steepest, (force - given_) / dt);
    if (force == 0 && given_ > 0) report_.silence = now - newest_;
    given_ = force;
  }

  Device& device_;
  const ForceTrial& trial_;
  const TrialTicks& ticks_;
  TrialReport& report_;
  LimiterState limiter_;
  HandSpeed hand_;
  double begin_ = 0, last_ = 0, newest_ = -1, speed_ = 0, given_ = 0;
  glm::dvec3 from_{0.0}, sum_{0.0};
  long samples_ = 0, averaged_ = 0;
  bool is_lost_ = false, was_released_ = false;
};

}  // namespace

TrialReport TryForce(Device& device, const ForceTrial& trial, const TrialTicks& ticks) {
  TrialReport report;
  double now = 0;
  if (WaitUntilArmed(device, trial, ticks, report, now))
    ArmedTrial(device, trial, ticks, report).Run(now);
  report.status = device.status();
  for (int i = 0; i < kLastZeros; ++i) {
    device.Read(ticks.next());
    device.HoldDeadMan(false);
    device.Command(glm::dvec3(0.0));
  }
  return report;
}

}  // namespace arthro::simulation
