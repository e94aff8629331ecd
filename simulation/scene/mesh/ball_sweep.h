// Sweep of a ball along a segment to its first contact with a solid that is known by a function:
// its distance, or a lower bound of it, and its normal. The ball advances by what the function
// allows, so it cannot tunnel. m; noexcept, allocates nothing.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace arthro {

// Contact of a swept ball, as SweepHit of a mesh.
struct BallHit {
  double fraction = 1;         // fraction of the path, 0..1, at which the ball touches
  glm::dvec3 normal{0, 0, 1};  // unit, from the surface to the ball's centre
  double gap = 0;              // m, negative if the ball penetrated the surface at the start
};

struct SweepLimits {
  double touch;     // m, gap that counts as contact
  double creep;     // m, advance of a ball that touches without approaching
  double steepest;  // largest slope of the function
  double deepest;   // m, largest penetration that is told
};

// Returns whether a ball moving from `from` to `to` meets the surface. Changes `hit` only for a
// contact earlier than hit.fraction; a separating motion passes. A grazing path that uses up its
// steps ends there.
template <class Distance, class Normal>
bool SweepBall(const Distance& distance_at, const Normal& normal_at, const SweepLimits& limits,
               const glm::dvec3& from, const glm::dvec3& to, double radius, BallHit& hit) noexcept {
  // Limit below which a motion counts as parallel and does not approach (as in SurfaceBvh).
  constexpr double kParallel = 1e-9;
  constexpr int kMaxSteps = 1000;
  const glm::dvec3 motion = to - from;
  const double length = glm::length(motion);
  if (!(length > 0.0) || !std::isfinite(length)) return false;
  const double end = hit.fraction * length;
  double way = 0.0;
  for (int step = 0; step < kMaxSteps && way < end; ++step) {
    const glm::dvec3 x = from + way / length * motion;
    const double gap = distance_at(x) - radius;
    if (gap > limits.touch) {
      way += std::max(gap / limits.steepest, 0.5 * limits.touch);
      continue;
    }
    const glm::dvec3 normal = normal_at(x);
    if (glm::dot(normal, motion) < -kParallel * length) {
      hit.fraction = way / length;
      hit.normal = normal;
      hit.gap = way > 0.0 ? 0.0 : std::max(-limits.deepest, std::min(0.0, gap));
      return true;
    }
    way += std::max(limits.creep, -0.5 * gap);
  }
  if (way >= end) return false;
  hit.fraction = way / length;
  hit.normal = normal_at(from + way / length * motion);
  hit.gap = 0.0;
  return true;
}

}  // namespace arthro
