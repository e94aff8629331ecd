#include "simulation/haptics/planes.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kSamePlane = 1e-10;   // 1 − cosine, 14 µrad
constexpr double kFeasible = 1e-9;     // m, rounding error at the smallest determinant below
constexpr double kIndependent = 1e-9;  // determinant of unit normals' products

// Solves for pushes p of the planes a, b, c with normals·(goal + Σ p n) = offsets; c, or b and c,
// may be -1.
bool Solve(const PlaneSet& planes, const glm::dvec3& goal, int a, int b, int c,
           double push[3]) noexcept {
  const auto normal = [&](int i) { return planes.plane[static_cast<std::size_t>(i)].normal; };
  const auto lack = [&](int i) {
    return planes.plane[static_cast<std::size_t>(i)].offset - glm::dot(normal(i), goal);
  };
  if (b < 0) {
    push[0] = lack(a);
    return true;
  }
  const double ab = glm::dot(normal(a), normal(b));
  if (c < 0) {
    const double det = 1.0 - ab * ab;
    if (det < kIndependent) return false;
    push[0] = (lack(a) - ab * lack(b)) / det;
    push[1] = (lack(b) - ab * lack(a)) / det;
    return true;
  }
  const double ac = glm::dot(normal(a), normal(c)), bc = glm::dot(normal(b), normal(c));
  const double det = 1.0 + 2.0 * ab * ac * bc - ab * ab - ac * ac - bc * bc;
  if (det < kIndependent) return false;
  const double la = lack(a), lb = lack(b), lc = lack(c);
  push[0] = ((1 - bc * bc) * la + (ac * bc - ab) * lb + (ab * bc - ac) * lc) / det;
  push[1] = ((ac * bc - ab) * la + (1 - ac * ac) * lb + (ab * ac - bc) * lc) / det;
  push[2] = ((ab * bc - ac) * la + (ab * ac - bc) * lb + (1 - ab * ab) * lc) / det;
  return true;
}

}  // namespace

bool PlaneSet::Add(const Plane& added) noexcept {
  for (int i = 0; i < count; ++i) {
    Plane& there = plane[static_cast<std::size_t>(i)];
    if (there.contact == added.contact && glm::dot(there.normal, added.normal) > 1.0 - kSamePlane)
      return there = added, true;
  }
  if (count == kCapacity) return false;
  plane[static_cast<std::size_t>(count++)] = added;
  return true;
}

NearestFree NearestPoint(const PlaneSet& planes, const glm::dvec3& goal,
                         const glm::dvec3& otherwise) noexcept {
  NearestFree result;
  const auto satisfied = [&](int a, int b, int c) noexcept {
    double push[3] = {0, 0, 0};
    if (a >= 0 && !Solve(planes, goal, a, b, c, push)) return false;
    NearestFree trial;
    trial.nearest = goal;
    const int chosen[3] = {a, b, c};
    for (int k = 0; k < 3; ++k) {
      if (chosen[k] < 0) break;
      if (push[k] < 0.0) return false;
      const auto i = static_cast<std::size_t>(chosen[k]);
      trial.push[i] = push[k];
      trial.nearest += push[k] * planes.plane[i].normal;
    }
    for (int i = 0; i < planes.count; ++i) {
      const Plane& plane = planes.plane[static_cast<std::size_t>(i)];
      if (glm::dot(plane.normal, trial.nearest) < plane.offset - kFeasible) return false;
    }
    result = trial;
    return true;
  };
  const int n = planes.count;
  if (satisfied(-1, -1, -1)) return result;
  for (int a = 0; a < n; ++a)
    if (satisfied(a, -1, -1)) return result;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (satisfied(a, b, -1)) return result;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = b + 1; c < n; ++c)
        if (satisfied(a, b, c)) return result;
  result.nearest = otherwise;
  return result;
}

}  // namespace arthro::simulation
