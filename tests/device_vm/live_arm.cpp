#include "tests/device_vm/live_arm.h"

#include <cmath>
#include <numbers>

namespace arthro::test {
namespace {

using namespace simulation;

constexpr double kPatience = 40;  // s of the guest
const char* const kModel = "woodenhaptics_2015";

LiveOptions Options(const std::filesystem::path& locks) {
  LiveOptions options;
  options.lock_folder = locks;
  return options;
}

// The hand's direction about the column is the base's angle.
int CounterAt(const glm::dvec3& hip) {
  const WoodenArm& arm = FindWoodenModel(kModel)->arm;
  const glm::dvec3 p = hip + arm.origin;
  return static_cast<int>(std::lround(std::atan2(p.y, p.x) * arm.counts_per_turn /
                                      (2 * std::numbers::pi * arm.transmission.x)));
}

void SleepUntil(double t) {
  timespec until{static_cast<time_t>(t), static_cast<long>((t - std::floor(t)) * 1e9)};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace

LiveArm::LiveArm(const std::string& serial)
    : link_(std::make_shared<LiveLink>(*bus_,
                                       DeviceRequest{DeviceFamily::kWoodenHaptics, serial, kModel},
                                       Options(locks_.path()))),
      device_(link_, 0) {
  ticks_.reserve(100000);
}

const ServoTick& LiveArm::Tick(const glm::dvec3& force, bool is_held) {
  ServoTick& tick = ticks_.emplace_back();
  tick.now = SteadySeconds();
  const DeviceSample sample = device_.Read(tick.now);
  device_.HoldDeadMan(is_held && !device_.status().must_release);
  device_.Command(force);
  tick.sample_t = sample.t;
  tick.status = device_.status();
  tick.is_valid = sample.valid;
  if (sample.valid) tick.counter = CounterAt(sample.hip_in_device);
  tick.force = device_.force();
  SleepUntil(tick.now + 1e-3);
  return tick;
}

bool LiveArm::RunUntil(const glm::dvec3& force, bool is_held,
                       const std::function<bool()>& is_over) {
  for (const double start = SteadySeconds(); SteadySeconds() - start < kPatience;) {
    Tick(force, is_held);
    if (is_over()) return true;
  }
  return false;
}

void LiveArm::Run(const glm::dvec3& force, bool is_held, double seconds) {
  for (const double start = SteadySeconds(); SteadySeconds() - start < seconds;)
    Tick(force, is_held);
}

bool LiveArm::Home() {
  const glm::dvec3 none(0.0);
  if (!RunUntil(none, false, [&] { return link_->opening() != 0; })) return false;
  link_->AskHome();
  return RunUntil(none, false, [&] { return state() == DeviceState::kReady; });
}

bool LiveArm::Push(const glm::dvec3& force) {
  return RunUntil(force, true, [&] { return ticks_.back().force == force; });
}

}  // namespace arthro::test
