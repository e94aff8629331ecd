// Passivity guard in the time domain: a rendered surface returns no more energy than it received
// [Hannaford & Ryu 2002; method.md, Stability]. A sampled spring responds one tick late, so each
// contact adds some energy to the hand. The guard removes the excess by a damper that acts only
// while a surface is touched. At the hand, device frame; m, N, N/m, J, s. noexcept, allocates
// nothing.
// The energy balance uses every count of the encoders, the velocity does not: one count in a tick
// of 1 ms looks like 55 mm/s, even at rest on the edge between two counts. The damper therefore
// sees motion with a backlash of one count, and a single count is spread over the time since the
// last one.
// A damper is too weak for slow hands. BoundByCredit does not depend on speed: the rendered spring
// may store no more energy than the hand has paid since it touched.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro::simulation {

struct PassivityOptions {
  double max_damping = 30.0;
  double allowance = 2e-4;
  int delay = 0;  // ticks; omitting one tick misses 1.7 mJ in a tap (goal: 1 mJ)
  double quantum = 0;
  template <class V>
  void Visit(V&& v) {
    v("guard_damping", max_damping, Range{0, 200}, "N s/m",
      "Largest damping of the passivity guard; 0 turns the guard off.");
    v("guard_allowance", allowance, Range{0, 0.01}, "J",
      "Energy that a surface may give back beyond what it took.");
    v("guard_delay", delay, Range{0, 7}, "",
      "Servo ticks from a command to the force; a larger value of the device takes precedence.");
    v("guard_quantum", quantum, Range{0, 1e-3}, "m",
      "Motion smaller than this is not damped; a larger count of the device takes precedence.");
  }
};

struct PassivityState {
  bool has_last = false;
  glm::dvec3 hand{0.0};              // position in the last tick
  std::array<glm::dvec3, 8> sent{};  // N on the hand, the newest at (count − 1) % 8
  std::uint64_t count = 0;
  double energy = 0;       // J, taken from the hand and not returned
  glm::dvec3 played{0.0};  // position of the hand, with backlash
  double still = 0;        // s, time since `played` moved
  // Used by BoundByCredit.
  bool has_credit = false;
  double credit = 0;  // J, paid by the hand and not returned; at most the energy of the spring
  glm::dvec3 paid_at{0.0};  // position of the hand, with backlash
};

// Spring at the hand: its stiffness, and the force at which it is clamped.
struct HandSpring {
  double stiffness = 0;  // N/m
  double max_force = 0;  // N
  // J, energy returned along the straight way out, where `force` is the force without the clamp.
  double EnergyOf(double force) const noexcept;
};

// Reduces `force` on the hand at `hand` so that the spring returns no more energy than the hand has
// paid plus twice the allowance. A clamp, a fade at the edge of a map, a turning lever and normals
// of a coarse map make a force that is no gradient of an energy, so a slow closed cycle could gain
// from each. The spring is softened and the clamp is kept: a deep hand feels the full clamp until
// its credit is used up. With `is_paid` the spring counts as paid, as while a force ramps after
// arming.
glm::dvec3 BoundByCredit(const PassivityOptions& options, const glm::dvec3& force,
                         const glm::dvec3& hand, const HandSpring& spring, bool is_paid, double dt,
                         PassivityState& state) noexcept;

// Returns `force` on the hand at `hand`, of a surface of `stiffness`, with the damper of the guard
// added. Energy lost to friction gives no credit: at most the energy of the spring is kept.
glm::dvec3 GuardPassivity(const PassivityOptions& options, const glm::dvec3& force,
                          const glm::dvec3& hand, double stiffness, double dt,
                          PassivityState& state) noexcept;
// Records the force after the limiter, which does the work on the hand.
void NoteSent(const glm::dvec3& force, PassivityState& state) noexcept;

}  // namespace arthro::simulation
