#include "tests/support/haptics/touch_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/core/random.h"

namespace arthro::test {
namespace {

using namespace simulation;

constexpr double kMass = 0.045, kDamping = 0.2;  // kg, N s/m

constexpr double kStart = 2e-3, kNear = 1e-4;  // m; a Touch-class device's two quanta

// Does a released device on the linear wall come to rest?
bool ComesToRest(double stiffness, double period, double damping, int delay) {
  HandPlant plant({kMass, kDamping, 0, 0, 1e9, delay}, kNoHand, {1e-3, 0, 0});
  double last = 1e-3, early = 0, late = 0;
  const int ticks = static_cast<int>(3.0 / period);
  for (int i = 0; i < ticks; ++i) {
    const double x = plant.position().x;
    if (!(std::abs(x) < 1.0)) return false;
    if (i >= ticks / 3)
      (i < ticks * 2 / 3 ? early : late) = std::max(i < ticks * 2 / 3 ? early : late, std::abs(x));
    plant.Tick({-stiffness * x - damping * (x - last) / period, 0, 0}, period);
    last = x;
  }
  return late < early;
}

Backdrop FlatWall(double radius) {
  Backdrop backdrop;
  backdrop.radius = radius;
  backdrop.projection.centre_px = {511.5, 511.5};
  backdrop.projection.focal_px = 500;
  return backdrop;
}

}  // namespace

double RuleStiffness(double period, double damping, int delay) {
  return (kDamping + damping) / (0.5 * period + delay * period);
}

double LargestStableStiffness(double period, double damping, int delay) {
  double low = 0, high = 2 * RuleStiffness(period, damping, delay);
  const double least = 1e-3 * high;  // N/m; a wall that oscillates even here is never stable
  while (high - low > 2e-3 * high && high > least) {
    const double middle = 0.5 * (low + high);
    (ComesToRest(middle, period, damping, delay) ? low : high) = middle;
  }
  return low > 0 ? 0.5 * (low + high) : 0;
}

TouchedWall::TouchedWall(const WallServo& servo, const PlantOptions& device, const HandModel& hand,
                         double at)
    : servo_(servo), field_(FlatWall(kWall), 1024, 1024), plant_(device, hand, {0, 0, kWall - at}) {
  contact_.stiffness = servo.stiffness;
  contact_.damping = servo.damping;
  limiter_.ramp_time = 0;  // armed long since
  passivity_.delay = servo.delay;
  if (!servo.is_guarded) passivity_.max_damping = 0;
}

void TouchedWall::Tick() noexcept {
  const glm::dvec3 hand = plant_.Sample().hip_in_device;
  const ContactForce contact = TickContact({field_, {}}, contact_, servo_.stiffness,
                                           {0, 0, kWall - 0.1}, hand, servo_.period, state_);
  TipForce tip;
  tip.force = contact.force;
  tip.stiffness = servo_.stiffness;
  tip.lever.across = tip.lever.fade = 1;
  tip.hand = hand;
  tip.hand_speed = glm::length(hand - hand_) / servo_.period;
  if (hand_ == glm::dvec3(0.0)) tip.hand_speed = 0;
  hand_ = hand;
  const glm::dvec3 sent =
      ForceToHand({passivity_, thermal_, limiter_}, tip, servo_.period, output_).force;
  force_ = -sent.z;
  plant_.Tick(sent, servo_.period);
}

HandTrial TryRandomHand(std::uint64_t number, const WallServo& servo) {
  Random random(number);
  const HandModel hand{random.Uniform(0.03, 0.6), random.Uniform(1, 12), random.Uniform(50, 900)};
  PlantOptions device;
  device.delay = servo.delay;
  device.friction = random.Uniform(0, 1) < 0.5 ? 0.0 : 0.26;
  TouchedWall wall(servo, device, hand, kStart);
  const double deep = random.Uniform(0.2e-3, 8e-3), speed = random.Uniform(0.04, 0.2);
  HandTrial trial;
  double low[2] = {1, 1}, high[2] = {-1, -1}, furthest = -1;
  const int ticks = static_cast<int>(0.7 / servo.period);
  for (int i = 0; i < ticks; ++i) {
    wall.SetIntent(std::max(-deep, kStart - speed * i * servo.period));
    wall.Tick();
    furthest = std::max(furthest, wall.position());
    const double part = static_cast<double>(i) / ticks;
    if (part < 0.5) continue;
    const int half = part < 0.75 ? 0 : 1;
    low[half] = std::min(low[half], wall.position());
    high[half] = std::max(high[half], wall.position());
  }
  const double before = high[0] - low[0];
  trial.swing = high[1] - low[1];
  trial.energy_out = wall.work();
  trial.has_escaped = (trial.swing > 0.5e-3 && trial.swing > before) || furthest > kStart + kNear;
  return trial;
}

double MostEnergyOut(const HandModel& hand, const WallServo& servo) {
  PlantOptions device;
  device.delay = servo.delay;
  device.friction = 0;
  double most = -1;
  for (const double hertz : {0.5, 1.0, 2.0, 4.0, 8.0})
    for (const double deep : {1e-3, 2e-3, 4e-3}) {
      TouchedWall wall(servo, device, hand, 2e-3);
      bool was_in = false;
      double entry = 0;
      const int ticks = static_cast<int>(3.0 / hertz / servo.period);
      for (int i = 0; i < ticks; ++i) {
        wall.SetIntent(0.5e-3 +
                       (deep + 0.5e-3) * std::cos(2 * std::numbers::pi * hertz * i * servo.period));
        wall.Tick();
        const bool is_in = wall.position() < 0;
        if (is_in && !was_in) entry = wall.work();
        if (!is_in && was_in) most = std::max(most, wall.work() - entry);
        was_in = is_in;
      }
    }
  return most;
}

}  // namespace arthro::test
