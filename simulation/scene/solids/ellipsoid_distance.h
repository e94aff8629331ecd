// Exact signed distance to an ellipsoid about the origin, and the unit outward normal at the
// nearest point of its surface. Own axes, m; noexcept, allocates nothing.
#pragma once

#include <glm/vec3.hpp>

namespace arthro {

struct EllipsoidDistance {
  double value = 0;  // m, negative inside
  glm::dvec3 normal{0, 0, 1};
};

EllipsoidDistance DistanceToEllipsoid(const glm::dvec3& radii, const glm::dvec3& x) noexcept;

}  // namespace arthro
