#include "app/steps/tissue/tissue_pose.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>

#include "simulation/core/units.h"

namespace arthro::app {

glm::dquat QuaternionOf(const glm::dvec3& degrees) {
  const glm::dvec3 half = 0.5 * kRadianPerDegree * degrees;
  const glm::dquat x(std::cos(half.x), std::sin(half.x), 0, 0);
  const glm::dquat y(std::cos(half.y), 0, std::sin(half.y), 0);
  const glm::dquat z(std::cos(half.z), 0, 0, std::sin(half.z));
  return z * y * x;
}

glm::dvec3 DegreesOf(const glm::dquat& rotation) {
  // R = Rz Ry Rx; m[column][row].
  const glm::dmat3 m = glm::mat3_cast(rotation);
  const double sin_y = std::clamp(-m[0][2], -1.0, 1.0);
  glm::dvec3 radians;
  radians.y = std::asin(sin_y);
  if (std::abs(sin_y) < 1.0 - 1e-12) {
    radians.x = std::atan2(m[1][2], m[2][2]);
    radians.z = std::atan2(m[0][1], m[0][0]);
  } else {
    radians.x = std::atan2(-m[2][1], m[1][1]);
    radians.z = 0.0;
  }
  return radians / kRadianPerDegree;
}

}  // namespace arthro::app
