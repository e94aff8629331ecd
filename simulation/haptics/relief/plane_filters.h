// Separable filters over planes of one number per pixel, row by row from the top. Pixels beyond the
// border have no mass: their value is 0.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "simulation/scene/pixel_bounds.h"

namespace arthro::simulation {

using FloatPlane = std::vector<float>;

// Weights of the outer taps of (1 2 1)/4, for one gap, between each pixel and the one that lies a
// gap to its right or below it: 1/4, and less to 0 where a step lies between them. Empty where
// there is no step.
struct OuterTaps {
  FloatPlane right, below;
};

// Applies `passes` passes of (1 2 1)/4 in both directions, as one binomial kernel.
void FilterBinomial(FloatPlane& data, int width, int height, int passes);

// Applies (1 2 1)/4 with `gap` pixels between its taps in both directions: adds gap²/2 to the
// variance, where all taps count. `scratch` may have any size. Only the pixels of `window`
// are written.
void Widen(FloatPlane& data, int width, int height, int gap, const OuterTaps& taps,
           const PixelBounds& window, FloatPlane& scratch);

// Widens several planes on two threads. Each is widened as a whole by one of them, so that the
// result does not depend on the threads.
void WidenAll(std::span<FloatPlane* const> planes, int width, int height, int gap,
              const OuterTaps& taps, const PixelBounds& window);

// Widens one plane on two threads, each for half of its rows: the same bytes.
void WidenOnTwoThreads(FloatPlane& data, int width, int height, int gap, const OuterTaps& taps,
                       const PixelBounds& window, FloatPlane& scratch);

// Replaces each value by the maximum over the square of (2 reach + 1) pixels about it, on two
// threads.
void Dilate(FloatPlane& data, int width, int height, int reach);

// Runs `rows(first, last)` on two halves of the rows from `begin` to `end`, on two threads. Each
// call writes only its own rows, so that the result does not depend on the threads.
void ForRowsOnTwoThreads(int begin, int end, const std::function<void(int first, int last)>& rows);

// The same for pixels in any shape: runs `pixel(i)`, which writes only what belongs to its pixel.
template <class Pixel>
void ForPixelsOnTwoThreads(std::size_t count, const Pixel& pixel) {
  ForRowsOnTwoThreads(0, static_cast<int>(count), [&](int first, int last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      pixel(i);
  });
}

}  // namespace arthro::simulation
