// Lever of the rod about the incision [method.md, Lever]. With u the unit vector from pivot to
// hand, r the distance of the hand and L the rod length, tip − pivot = (r − L) u and
//   J = d tip/d hand = u uᵀ + (1 − L/r)(I − u uᵀ),   F_hand = Jᵀ F_tip.
// Across the rod a force grows by |1 − L/r| and a stiffness by its square, so the limits of the
// device apply to the product. All vectors are in the same frame; m, N, N/m.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro::simulation {

struct LeverOptions {
  // 13 times the force at L = 0.2 m; nearer, tremor of the hand dominates.
  double fade_begin = 0.015;
  double fade_end = 0.005;
  double max_stiffness = 780.0;  // N/m; stability bound at 1 kHz, one tick of delay, b = 1.2 Ns/m
  template <class V>
  void Visit(V&& v) {
    v("fade_begin", fade_begin, Range{1e-3, 0.1}, "m",
      "Distance of the hand from the incision below which the force fades.");
    v("fade_end", fade_end, Range{1e-4, 0.1}, "m",
      "Distance of the hand from the incision at which the force is zero.");
    v("max_stiffness", max_stiffness, Range{10, 1e5}, "N/m",
      "Largest stiffness that the device can show at the hand.");
  }
};

struct Lever {
  glm::dvec3 axis{0, 0, -1};  // u
  double across = 1;          // 1 − L/r
  double fade = 0;            // 0..1
  double max_stiffness = 0;   // N/m at the tip, at the limit of the device at the hand
};

Lever LeverAt(const glm::dvec3& hand_from_pivot, double rod_length,
              const LeverOptions& options) noexcept;

// Returns Jᵀ F_tip, faded.
glm::dvec3 HandForce(const Lever& lever, const glm::dvec3& tip_force) noexcept;

}  // namespace arthro::simulation
