#include "simulation/device/driver/rate_hand.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kLongestStep = 0.1;  // s; avoids a leap after a pause

}  // namespace

double Meant(double push, double dead_zone) noexcept {
  const double beyond = std::min(std::abs(push), 1.0) - dead_zone;
  if (!(beyond > 0)) return 0;  // also for NaN
  return std::copysign(beyond / (1 - dead_zone), push);
}

void Advance(RateHand& hand, const glm::dvec3& push, const glm::dvec3& turn, double dt,
             const glm::dvec3& min, const glm::dvec3& max, const RateOptions& options) noexcept {
  if (!(dt > 0)) return;
  dt = std::min(dt, kLongestStep);
  glm::dvec3 way, angle;
  for (int i = 0; i < 3; ++i) {
    way[i] = options.speed * dt * Meant(push[i], options.dead_zone);
    angle[i] = options.turn_speed * dt * Meant(turn[i], options.dead_zone);
  }
  hand.position = glm::clamp(hand.position + way, min, max);
  if (const double a = glm::length(angle); a > 0)
    hand.orientation = glm::normalize(glm::angleAxis(a, angle / a) * hand.orientation);
}

}  // namespace arthro::simulation
