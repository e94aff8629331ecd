// A force device with a hand on it, as a plant to try a servo on [devices.md, Simulated hand]: on
// each axis
//   (m_d + m_h) a = k_h (x_intent − x) − (b_d + b_h) v − f_c sgn(v) + F,
// F what the device was commanded `delay` ticks ago, clamped to its peak. Integrated in steps of at
// most 20 µs; what is read is quantised as its encoders do. Device frame, m, N, kg, s. Same inputs,
// same bits; allocates nothing once made.
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "simulation/device/device_sample.h"

namespace arthro::simulation {

// Values of a Touch-class device; 0 leaves a part out.
struct PlantOptions {
  double mass = 0.045;      // kg
  double damping = 0.2;     // N s/m
  double friction = 0.26;   // N, Coulomb's
  double quantum = 5.5e-5;  // m
  double peak_force = 3.3;  // N
  int delay = 1;            // ticks from command to force, at most 7
};

struct HandModel {
  double mass = 0, damping = 0, stiffness = 0;  // kg, N s/m, N/m
};
inline constexpr HandModel kNoHand{}, kSoftHand{0.05, 2, 100}, kHand{0.1, 5, 300},
    kStiffHand{0.2, 10, 800}, kWholeArm{0.55, 6.5, 135};

class HandPlant {
 public:
  HandPlant(const PlantOptions& options, const HandModel& hand, const glm::dvec3& at);

  // Where the hand means to be. Without stiffness it means nothing.
  void SetIntent(const glm::dvec3& intent) noexcept { intent_ = intent; }
  // One tick of a servo: the force that it commands now, then `dt` of time. What is not finite is
  // no force.
  void Tick(const glm::dvec3& command, double dt) noexcept;

  // What the device says now; orientation is none.
  DeviceSample Sample() const noexcept;
  const glm::dvec3& position() const noexcept { return x_; }
  const glm::dvec3& velocity() const noexcept { return v_; }
  void SetVelocity(const glm::dvec3& v) noexcept { v_ = v; }
  // J, work that the commanded forces have done on the hand so far.
  double work() const noexcept { return work_; }

 private:
  static constexpr std::size_t kLongestDelay = 8;
  PlantOptions options_;
  HandModel hand_;
  glm::dvec3 x_, v_{0.0}, intent_;
  std::array<glm::dvec3, kLongestDelay> commands_{};
  std::size_t tick_ = 0;
  double t_ = 0, work_ = 0;
};

}  // namespace arthro::simulation
