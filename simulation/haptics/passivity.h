// A guard that lets the rendered surface give back no more energy than it took: time-domain
// passivity [Hannaford & Ryu 2002; method.md, Stability]. A sampled spring gives a hand some
// energy at every touch, since it answers a tick late; what it has given too much is taken out by a
// damper that works only then, while something is touched. At the hand, device frame; m, N, N/m, J,
// s. noexcept, allocates nothing. What is owed is reckoned from every count of the device; how fast
// the hand goes is not: one count in a tick of 1 ms looks like 55 mm/s, at rest on the edge of two
// as in a slow stroke. The damper sees motion with a play of one count, and a single count spread
// over the time since the last.
// A damper is too weak for slow hands. The second part, BoundByCredit, is independent of speed: the
// rendered spring may promise no more energy than the hand has paid for since it touched.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro::simulation {

struct PassivityOptions {
  double max_damping = 30.0;
  double allowance = 2e-4;
  int delay = 0;  // with one that is left out, 1.7 mJ go unseen in a tap (goal: 1 mJ)
  double quantum = 0;
  template <class V>
  void Visit(V&& v) {
    v("guard_damping", max_damping, Range{0, 200}, "N s/m",
      "Strongest damper of the passivity guard; 0: no guard.");
    v("guard_allowance", allowance, Range{0, 0.01}, "J",
      "Energy that a surface may give back beyond what it took.");
    v("guard_delay", delay, Range{0, 7}, "",
      "Servo ticks from a command to the force; what a device says of itself counts if more.");
    v("guard_quantum", quantum, Range{0, 1e-3}, "m",
      "Motion by less is not damped; a count of the device, if that is more.");
  }
};

struct PassivityState {
  bool has_last = false;
  glm::dvec3 hand{0.0};              // of the last tick
  std::array<glm::dvec3, 8> sent{};  // on the hand, the newest at (count − 1) % 8
  std::uint64_t count = 0;
  double energy = 0;       // J, taken from the hand and not given back
  glm::dvec3 played{0.0};  // where the hand is, with play
  double still = 0;        // s, that this has not moved
  // Used by BoundByCredit.
  bool has_credit = false;
  double credit = 0;        // J, paid by the hand and not given back; at most what the spring holds
  glm::dvec3 paid_at{0.0};  // where the hand is, with play
};

// The spring that a hand feels: its stiffness, and the force at which it is clamped.
struct HandSpring {
  double stiffness = 0;  // N/m
  double max_force = 0;  // N
  // J, that it gives back on the straight way out, where `force` is its force without the clamp.
  double EnergyOf(double force) const noexcept;
};

// `force` on the hand at `hand`, or less of it: so much that the spring gives back no more than the
// hand has paid, and twice the allowance. A clamp, a fade at the edge of a map, a lever that turns
// and normals of a coarse map make a force that is no gradient of an energy; a slow closed cycle
// can gain from each of them. The spring is softened, not the clamp lowered: a hand that is deep
// feels the full clamp until what it paid is used up. Unchanged where nothing is owed. With
// `is_paid` the spring is taken as paid for, as while a force ramps after arming.
glm::dvec3 BoundByCredit(const PassivityOptions& options, const glm::dvec3& force,
                         const glm::dvec3& hand, const HandSpring& spring, bool is_paid, double dt,
                         PassivityState& state) noexcept;

// `force` on the hand at `hand`, of a surface of `stiffness`; what it is with the guard's damper.
// Energy that rubbing took is no licence to swing: no more is kept than the surface's spring holds.
glm::dvec3 GuardPassivity(const PassivityOptions& options, const glm::dvec3& force,
                          const glm::dvec3& hand, double stiffness, double dt,
                          PassivityState& state) noexcept;
// What was sent in the end, after the limiter: that is what did the work.
void NoteSent(const glm::dvec3& force, PassivityState& state) noexcept;

}  // namespace arthro::simulation
