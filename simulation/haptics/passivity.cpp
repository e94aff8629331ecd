#include "simulation/haptics/passivity.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr double kRounding = 1e-6;  // of a count
constexpr double kForgiving = 0.1;  // s, three swings of a hand that is thrown

// What the motors did since the last tick.
const glm::dvec3& Acting(const PassivityOptions& options, const PassivityState& state) noexcept {
  const std::size_t size = state.sent.size();
  const auto delay = static_cast<std::uint64_t>(std::clamp(options.delay, 0, 7));
  return state.sent[(state.count + size - 1 - delay) % size];
}

// Axis by axis, as a device counts: along one a hand may rest while it strokes along another.
glm::dvec3 WithPlay(const glm::dvec3& off, double play) noexcept {
  glm::dvec3 way = off;
  for (int axis = 0; axis < 3 && play > 0; ++axis) {
    const double past = std::abs(off[axis]) - play;
    way[axis] = past < kRounding * play ? 0.0 : std::copysign(past, off[axis]);
  }
  return way;
}

}  // namespace

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
  // What the spring holds now, and nothing of what was rubbed away.
  const double held = stiffness > 0 ? 0.5 * force2 / stiffness : 0.0;
  state.energy = std::min(state.energy, held);
  // In the air there is nothing to damp. What was owed is forgiven in time, not at once: a hand
  // that a surface throws comes back soon.
  if (!(force2 > 0)) {
    state.energy *= kForgiving / (kForgiving + dt);
    return force;
  }
  const double over = -options.allowance - state.energy;
  if (!(over > 0) || !(seen2 > 0)) return force;
  // A damper that would take it out within this tick, at the speed of the last one.
  const double damping = std::min(over * took * took / (seen2 * dt), options.max_damping);
  return force - damping / took * seen;
}

void NoteSent(const glm::dvec3& force, PassivityState& state) noexcept {
  state.sent[state.count++ % state.sent.size()] = force;
}

}  // namespace arthro::simulation
