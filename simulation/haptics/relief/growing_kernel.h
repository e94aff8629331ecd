// A kernel that grows by (1 2 1)/4 with ever wider gaps, until each pixel of a map has the
// smoothing that it asks for; and the rectangles of pixels that each growth has to compute.
#pragma once

#include <vector>

#include "simulation/haptics/relief/plane_filters.h"
#include "simulation/scene/image.h"
#include "simulation/scene/pixel_bounds.h"

namespace arthro::simulation {

// Gaps of the growths to a smoothing of this standard deviation, px.
std::vector<int> GapsOf(double deviation_px);

// Pixels to each side that such a smoothing reads.
int ReachOf(double deviation_px);

// Variance that a growth adds, px².
inline float AddedVariance(int gap) {
  return 0.5f * static_cast<float>(gap) * static_cast<float>(gap);
}

struct Growth {
  int gap = 0, reach = 0;      // px; the reach of all growths up to this one
  float variance = 0;          // px², before it
  PixelBounds window, uneven;  // all pixels to compute; those whose kernel may not be even
};

// Square blocks of a map by their distance to pixels that make a kernel uneven: unknown, near a
// step, or beyond the border.
struct EvenBlocks {
  static constexpr int kSide = 16;  // px
  int columns = 0, rows = 0;
  std::vector<int> distance;  // px at least, to what is uneven; 0: holds some
};
// `near`: how near each pixel is to a step; empty: there is none.
EvenBlocks EvenBlocksOf(const DepthMap& depth, const FloatPlane& near);

// Growths that give the pixels of `wanted` the smoothing `deviation`, px: the pixels that still ask
// for it, and what the next growth reads. Growths that no pixel asks for are left out at the end.
// `passes`: reach of the smoothing before the first one, px.
std::vector<Growth> GrowthsOf(const PixelBounds& wanted, const FloatPlane& deviation,
                              const EvenBlocks& blocks, int passes, const std::vector<int>& gaps,
                              int width, int height);

}  // namespace arthro::simulation
