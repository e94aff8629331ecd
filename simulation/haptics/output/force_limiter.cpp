#include "simulation/haptics/output/force_limiter.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {
LimitedForce LimitForce(const LimiterOptions& options, const glm::dvec3& force, double hand_speed,
                        Fault fault, double dt, LimiterState& state) noexcept {
  if (fault == Fault::kNone && !(IsFinite(force) && std::isfinite(hand_speed)))
    fault = Fault::kNotFinite;
  if (fault == Fault::kNone && hand_speed > options.max_hand_speed) fault = Fault::kTooFast;
  const double step = std::isfinite(dt) ? std::max(dt, 0.0) : 0.0;
  if (fault != Fault::kNone) {
    state = LimiterState{};
    return {glm::dvec3(0.0), fault};
  }
  // Divides by the largest component first, so that neither 1e300 nor a denormal breaks the length.
  const double largest = std::max({std::abs(force.x), std::abs(force.y), std::abs(force.z)});
  glm::dvec3 direction(0.0);
  double length = 0.0;
  if (largest > 0.0) {
    const glm::dvec3 scaled = force / largest;
    direction = glm::normalize(scaled);
    length = std::min(largest * glm::length(scaled), options.max_force);
  }
  // Keeps the component of the last force along the new direction; beyond it the force rises at the
  // limit. A reversed force starts from zero.
  const double held = std::max(0.0, glm::dot(state.held, direction));
  state.held = std::min(length, held + options.max_rise * step) * direction;
  state.ramp = options.ramp_time > 0.0 ? std::min(1.0, state.ramp + step / options.ramp_time) : 1.0;
  return {state.ramp * state.held, Fault::kNone};
}

}  // namespace arthro::simulation
