// The rod about the incision is a lever [method.md, Lever]: with u the unit vector from pivot
// to hand, r its length and L the rod's, tip − pivot = (r − L) u and
//   J = d tip/d hand = u uᵀ + (1 − L/r)(I − u uᵀ),   F_hand = Jᵀ F_tip.
// Across the rod a force grows by |1 − L/r| and a stiffness by its square, so limits of the device
// hold for the product. Any one frame for all vectors; m, N, N/m.
#pragma once

#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro::simulation {

struct LeverOptions {
  double fade_begin =
      0.015;  // 13 times the force at L = 0.2; nearer, the hand's own tremor steers it
  double fade_end = 0.005;
  double max_stiffness = 780.0;  // notes 4.5: the bound at 1 kHz, one tick of delay, b = 1.2 Ns/m
  template <class V>
  void Visit(V&& v) {
    v("fade_begin", fade_begin, Range{1e-3, 0.1}, "m",
      "With the hand nearer to the incision than this, the force fades.");
    v("fade_end", fade_end, Range{1e-4, 0.1}, "m", "Here it is gone.");
    v("max_stiffness", max_stiffness, Range{10, 1e5}, "N/m",
      "Largest stiffness that the device can show at the hand.");
  }
};

struct Lever {
  glm::dvec3 axis{0, 0, -1};  // u
  double across = 1;          // 1 − L/r
  double fade = 0;            // 0..1
  double max_stiffness = 0;   // at the tip, so that the hand feels at most the device's
};

Lever LeverAt(const glm::dvec3& hand_from_pivot, double rod_length,
              const LeverOptions& options) noexcept;

// Jᵀ F_tip, faded.
glm::dvec3 HandForce(const Lever& lever, const glm::dvec3& tip_force) noexcept;

}  // namespace arthro::simulation
