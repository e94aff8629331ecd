#include "simulation/core/geometry/triangle.h"

#include <glm/geometric.hpp>

namespace arthro {

glm::dvec3 ClosestOnTriangle(const TriangleCorners& corner, const glm::dvec3& x) noexcept {
  const glm::dvec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0], ax = x - corner[0];
  const double d1 = glm::dot(ab, ax), d2 = glm::dot(ac, ax);
  if (d1 <= 0.0 && d2 <= 0.0) return {1, 0, 0};
  const glm::dvec3 bx = x - corner[1];
  const double d3 = glm::dot(ab, bx), d4 = glm::dot(ac, bx);
  if (d3 >= 0.0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 - d3 > 0.0 ? d1 / (d1 - d3) : 0.0;
    return {1.0 - v, v, 0};
  }
  const glm::dvec3 cx = x - corner[2];
  const double d5 = glm::dot(ab, cx), d6 = glm::dot(ac, cx);
  if (d6 >= 0.0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 - d6 > 0.0 ? d2 / (d2 - d6) : 0.0;
    return {1.0 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double whole = (d4 - d3) + (d5 - d6);
    const double w = whole > 0.0 ? (d4 - d3) / whole : 0.0;
    return {0, 1.0 - w, w};
  }
  const double sum = va + vb + vc;
  if (!(sum > 0.0)) return {1, 0, 0};  // no area, and on none of its edges: not a number
  return {1.0 - (vb + vc) / sum, vb / sum, vc / sum};
}

double Distance2(const TriangleCorners& corner, const glm::dvec3& x) noexcept {
  const glm::dvec3 way = x - PointOn(corner, ClosestOnTriangle(corner, x));
  return glm::dot(way, way);
}

}  // namespace arthro
