#include "simulation/haptics/output/lever.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace arthro::simulation {

Lever LeverAt(const glm::dvec3& hand_from_pivot, double rod_length,
              const LeverOptions& options) noexcept {
  Lever lever;
  const double r = glm::length(hand_from_pivot);
  const double end = std::min(options.fade_end, options.fade_begin);
  if (!(r > end) || !(r > 0.0)) return lever;  // no force: its direction is too uncertain
  const double s =
      options.fade_begin > end ? std::clamp((r - end) / (options.fade_begin - end), 0.0, 1.0) : 1.0;
  lever.axis = hand_from_pivot / r;
  lever.across = 1.0 - rod_length / r;
  lever.fade = s * s * (3.0 - 2.0 * s);
  lever.max_stiffness = options.max_stiffness / std::max(1.0, lever.across * lever.across);
  return lever;
}

glm::dvec3 HandForce(const Lever& lever, const glm::dvec3& tip_force) noexcept {
  const double along = glm::dot(lever.axis, tip_force);
  return lever.fade * (along * lever.axis + lever.across * (tip_force - along * lever.axis));
}

}  // namespace arthro::simulation
