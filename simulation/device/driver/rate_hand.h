// A hand that is led by how hard a knob is pushed and turned: speed by the push beyond a dead zone,
// within a box. Device frame, m, rad, s.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace arthro::simulation {

struct RateOptions {
  double dead_zone = 0.06;  // of full push, 21 of 350 counts; knobs at rest show up to 15
  double speed = 0.08;      // m/s at full push; surgery's slow strokes
  double turn_speed = 1.5;  // rad/s at full turn
};

struct RateHand {
  glm::dvec3 position{0.0};
  glm::dquat orientation{1, 0, 0, 0};  // unit
};

// What of −1 to 1 is meant: nothing within the dead zone, and from its edge on evenly to 1.
double Meant(double push, double dead_zone) noexcept;

// `push` and `turn` in −1 to 1 each; what is not a number moves nothing. A turn is about the
// device's axes.
void Advance(RateHand& hand, const glm::dvec3& push, const glm::dvec3& turn, double dt,
             const glm::dvec3& min, const glm::dvec3& max, const RateOptions& options) noexcept;

}  // namespace arthro::simulation
