// Hand that is led by a knob: its speed is proportional to the push beyond a dead zone, within a
// box. Device frame, m, rad, s.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace arthro::simulation {

struct RateOptions {
  double dead_zone = 0.06;  // share of full push, 21 of 350 counts; knobs at rest show up to 15
  double speed = 0.08;      // m/s at full push, as slow strokes in surgery
  double turn_speed = 1.5;  // rad/s at full turn
};

struct RateHand {
  glm::dvec3 position{0.0};
  glm::dquat orientation{1, 0, 0, 0};  // unit
};

// Applies the dead zone to a value of −1 to 1: zero within it, then linear from its edge to 1.
double Meant(double push, double dead_zone) noexcept;

// Moves the hand by `push` and `turn`, each −1 to 1; NaN moves nothing. A turn is about the axes of
// the device.
void Advance(RateHand& hand, const glm::dvec3& push, const glm::dvec3& turn, double dt,
             const glm::dvec3& min, const glm::dvec3& max, const RateOptions& options) noexcept;

}  // namespace arthro::simulation
