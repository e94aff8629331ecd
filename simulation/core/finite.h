// Tests for NaN and infinity.
#pragma once

#include <cmath>
#include <span>

#include <glm/vec3.hpp>

namespace arthro {

inline bool IsFinite(const glm::dvec3& x) noexcept {
  return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

// Vectorises: 0 * x is 0 for a finite x and NaN otherwise.
inline bool AllFinite(std::span<const glm::dvec3> points) noexcept {
  double sum = 0;
  for (const glm::dvec3& x : points) sum += 0.0 * x.x + 0.0 * x.y + 0.0 * x.z;
  return sum == 0.0;
}

}  // namespace arthro
