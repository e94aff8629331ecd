// Rays of a lens that a rectified picture (rectifier.h) shows.
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

struct RectifyOptions {
  double rim_margin = 0.03;            // share of the circle's radius, excluded at the rim
  double largest_half_angle = 1.2217;  // rad (70°); rays further off the axis are excluded

  template <class V>
  void Visit(V&& v) {
    v("rim_margin", rim_margin, Range{0.0, 0.5}, "",
      "Share of the round window's radius that is left out at its rim.");
    v("largest_half_angle", largest_half_angle, Range{0.05, 1.4}, "rad",
      "Rays further off the axis are left out, since a flat picture would stretch them too far.");
  }
};

}  // namespace arthro::authoring
