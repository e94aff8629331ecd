#include "simulation/scene/solids/ellipsoid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro {
namespace {

// A point on a plane of symmetry may have two nearest points; it is moved by this share of the
// least radius, so that one of them is taken.
constexpr double kOffPlane = 1e-9;
constexpr double kConverged = 1e-13;
// The root lies within 5 steps for all but points near the centre of flat ellipsoids.
constexpr int kMostSteps = 40;

}  // namespace

// The nearest point c of x satisfies c = r² x / (t + r²) per axis for the largest root t of
// |p(t)| = 1 with p = r x / (t + r²) [Eberly 2013]. Newton's method on 1 / |p(t)| − 1, which is
// nearly straight.
EllipsoidDistance DistanceToEllipsoid(const glm::dvec3& radii, const glm::dvec3& x) noexcept {
  const glm::dvec3 r2 = radii * radii;
  const double least = std::min({radii.x, radii.y, radii.z});
  const glm::dvec3 y = glm::max(glm::abs(x), glm::dvec3(kOffPlane * least));
  const glm::dvec3 over = r2 - least * least, start = radii * y - over;
  double s = std::max({start.x, start.y, start.z});  // |p| is 1 or more here
  for (int step = 0; step < kMostSteps; ++step) {
    const glm::dvec3 below = s + over, p = radii * y / below;
    const double n = glm::length(p), slope = glm::dot(p, p / below);
    if (!(slope > 0.0)) break;
    const double way = (n - 1.0) * n * n / slope;
    s += way;
    if (std::abs(n - 1.0) < kConverged) break;
  }
  const glm::dvec3 nearest = r2 * y / (s + over), share = x / radii;
  const double away = glm::distance(y, nearest);
  const glm::dvec3 slope = nearest / r2;
  EllipsoidDistance result;
  result.value = glm::dot(share, share) < 1.0 ? -away : away;
  for (int axis = 0; axis < 3; ++axis) result.normal[axis] = std::copysign(slope[axis], x[axis]);
  result.normal = glm::normalize(result.normal);
  return result;
}

}  // namespace arthro
