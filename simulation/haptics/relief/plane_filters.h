// Separable filters over planes of one number per pixel, row by row from the top. Pixels beyond the
// border have no mass: their value is 0.
#pragma once

#include <span>
#include <vector>

namespace arthro::simulation {

using Plane = std::vector<float>;

// Weights of the outer taps of (1 2 1)/4 per pixel, for one gap: 1/4, and less to 0 where a tap
// lies beyond a step. Empty where there is no step.
struct OuterTaps {
  Plane left, right, above, below;
};

// Applies `passes` passes of (1 2 1)/4 in both directions, as one binomial kernel.
void FilterBinomial(Plane& data, int width, int height, int passes);

// Applies (1 2 1)/4 with `gap` pixels between its taps in both directions: adds gap²/2 to the
// variance, where all taps count. `scratch` may have any size.
void Widen(Plane& data, int width, int height, int gap, const OuterTaps& taps, Plane& scratch);

// Widens several planes on two threads. Each is widened as a whole by one of them, so that the
// result does not depend on the threads.
void WidenAll(std::span<Plane* const> planes, int width, int height, int gap,
              const OuterTaps& taps);

}  // namespace arthro::simulation
