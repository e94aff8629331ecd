#include "simulation/haptics/output/passivity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kRounding = 1e-6;  // counts
constexpr double kForgiving = 0.1;  // s, three oscillations of a hand that a surface throws back
// Larger than the allowance of the damper, so that a spring is softened only where the damper was
// too weak.
constexpr double kCreditAllowances = 2.0;

// Force that acted since the last tick.
const glm::dvec3& Acting(const PassivityOptions& options, const PassivityState& state) noexcept {
  const std::size_t size = state.sent.size();
  const auto delay = static_cast<std::uint64_t>(std::clamp(options.delay, 0, 7));
  return state.sent[(state.count + size - 1 - delay) % size];
}

// Applies backlash per axis, as a device counts: a hand may rest along one axis while it moves
// along another.
glm::dvec3 WithPlay(const glm::dvec3& off, double play) noexcept {
  glm::dvec3 way = off;
  for (int axis = 0; axis < 3 && play > 0; ++axis) {
    const double past = std::abs(off[axis]) - play;
    way[axis] = past < kRounding * play ? 0.0 : std::copysign(past, off[axis]);
  }
  return way;
}

// Factor by which a spring of this force must be softened to store no more than `energy`.
double ShareFor(const HandSpring& spring, double force, double energy) noexcept {
  const double stretch = force / spring.stiffness;
  if (!(energy > 0)) return 0;
  // Distinguishes whether the softer spring is still clamped.
  if (energy > 0.5 * spring.max_force * stretch)
    return 0.5 * spring.max_force * spring.max_force /
           (spring.stiffness * (spring.max_force * stretch - energy));
  return 2.0 * energy / (force * stretch);
}

}  // namespace

double HandSpring::EnergyOf(double force) const noexcept {
  if (!(stiffness > 0)) return 0;
  const double stretch = force / stiffness;
  return force <= max_force ? 0.5 * force * stretch
                            : max_force * (stretch - 0.5 * max_force / stiffness);
}

glm::dvec3 BoundByCredit(const PassivityOptions& options, const glm::dvec3& force,
                         const glm::dvec3& hand, const HandSpring& spring, bool is_paid, double dt,
                         PassivityState& state) noexcept {
  const double size = glm::length(force);
  const double way2 = glm::dot(hand - state.paid_at, hand - state.paid_at);
  const double held = spring.EnergyOf(size);
  if (!std::isfinite(way2) || !std::isfinite(held) || !(dt > 0) || !(options.max_damping > 0) ||
      (size > 0 && !(spring.stiffness > 0))) {
    state.has_credit = false;
    return force;
  }
  if (!std::exchange(state.has_credit, true)) {
    state.paid_at = hand;
    state.credit = held;
    return force;
  }
  const glm::dvec3 way = WithPlay(hand - state.paid_at, options.quantum);
  state.paid_at += way;
  state.credit -= glm::dot(Acting(options, state), way);
  // Credit beyond the energy of the spring was lost to friction or damping.
  state.credit = is_paid ? held : std::min(state.credit, held);
  if (!(size > 0)) {
    state.credit *= kForgiving / (kForgiving + dt);
    return force;
  }
  const double energy = state.credit + kCreditAllowances * options.allowance;
  if (!(energy < held)) return force;
  return ShareFor(spring, size, energy) * force;
}

glm::dvec3 GuardPassivity(const PassivityOptions& options, const glm::dvec3& force,
                          const glm::dvec3& hand, double stiffness, double dt,
                          PassivityState& state) noexcept {
  const glm::dvec3 way = hand - state.hand;
  const double way2 = glm::dot(way, way), force2 = glm::dot(force, force);
  const bool is_new = !state.has_last;
  state.hand = hand;
  state.has_last = true;
  if (!std::isfinite(way2) || !std::isfinite(force2) || !(dt > 0)) {
    state = PassivityState{};
    return force;
  }
  if (is_new) {
    state.energy = 0;
    state.played = hand;
    return force;
  }
  const glm::dvec3 seen = WithPlay(hand - state.played, options.quantum);
  const double seen2 = glm::dot(seen, seen), count2 = options.quantum * options.quantum;
  state.played += seen;
  const bool is_count = seen2 > 0 && seen2 < 2.25 * count2;
  const double took = is_count ? state.still + dt : dt;
  state.still = seen2 > 0 ? 0.0 : state.still + dt;
  state.energy -= glm::dot(Acting(options, state), way);
  // Keeps at most the energy of the spring, and none that friction took.
  const double held = stiffness > 0 ? 0.5 * force2 / stiffness : 0.0;
  state.energy = std::min(state.energy, held);
  // Without contact there is nothing to damp. The debt decays slowly, since a hand that a surface
  // throws back returns soon.
  if (!(force2 > 0)) {
    state.energy *= kForgiving / (kForgiving + dt);
    return force;
  }
  const double over = -options.allowance - state.energy;
  if (!(over > 0) || !(seen2 > 0)) return force;
  // Chooses the damping that removes the excess within this tick at the present speed.
  const double damping = std::min(over * took * took / (seen2 * dt), options.max_damping);
  return force - damping / took * seen;
}

void NoteSent(const glm::dvec3& force, PassivityState& state) noexcept {
  state.sent[state.count++ % state.sent.size()] = force;
}

}  // namespace arthro::simulation
