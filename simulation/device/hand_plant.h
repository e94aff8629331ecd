// Simulated force device with a hand on it, for tests of a servo [devices.md, Simulated hand]. On
// each axis
//   (m_d + m_h) a = k_h (x_intent − x) − (b_d + b_h) v − f_c sgn(v) + F,
// where F is the command of `delay` ticks ago, clamped to the peak force. Integrated in steps of at
// most 20 µs; positions are quantised as by encoders. Device frame, m, N, kg, s. The same inputs
// give the same bits; allocates only when constructed.
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "simulation/device/device_sample.h"

namespace arthro::simulation {

// Values of a Touch-class device; 0 omits a term.
struct PlantOptions {
  double mass = 0.045;      // kg
  double damping = 0.2;     // N s/m
  double friction = 0.26;   // N, Coulomb friction
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

  // Sets the intended position of the hand. It has no effect without stiffness.
  void SetIntent(const glm::dvec3& intent) noexcept { intent_ = intent; }
  // Advances by one servo tick of `dt` after a command. A command that is not finite counts as no
  // force.
  void Tick(const glm::dvec3& command, double dt) noexcept;

  // Sample of the device, without an orientation.
  DeviceSample Sample() const noexcept;
  const glm::dvec3& position() const noexcept { return x_; }
  const glm::dvec3& velocity() const noexcept { return v_; }
  void SetVelocity(const glm::dvec3& v) noexcept { v_ = v; }
  // J, work of the commanded forces on the hand so far.
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
