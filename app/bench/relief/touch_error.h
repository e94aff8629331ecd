// Force over a found surface beside the force over the true one, at random touches [method.md,
// Backdrop force].
#pragma once

#include "tests/support/relief/surface_score.h"

namespace arthro::app {

struct TouchError {
  int touches = 0;
  double rms = 0;       // N, of the difference of the two forces
  double true_rms = 0;  // N, of the force over the true surface
  double felt = 0;      // share of the touches at which the found surface gives a force
};

// Tips lie 0.2 to 2 mm below the true surface where three frames see it, and come straight from
// the portal. The same seed gives the same touches for every surface.
TouchError MeasureTouches(const test::FoundSurface& found, const test::TrueSurface& truth,
                          int touches, int seed);

}  // namespace arthro::app
