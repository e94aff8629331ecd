// The depth filter at the speed of a slider: the same filter on a smaller level of the panorama's
// pyramid, with pixel options scaled to it.
#pragma once

#include <vector>

#include "authoring/depth/depth_filter.h"

namespace arthro::authoring {

class DepthPreview {
 public:
  // Pixels that are filtered well within a frame on one core.
  static constexpr int kMostPixels = 1 << 18;

  // Halves the panorama until few pixels are left. Glints and surround do not bleed into the
  // averages.
  explicit DepthPreview(const ColourImage& panorama);

  // The relief on the largest level of at most `most_pixels` pixels, or the smallest there is.
  DepthMap Filter(const DepthOptions& options, DepthReport* report = nullptr,
                  int most_pixels = kMostPixels) const;

  // How many pixels of the panorama, along a side, are one of that level; pixel (x, y) of it covers
  // x*factor … x*factor + factor-1.
  int Factor(int most_pixels = kMostPixels) const;

  // The colours of that level, to show beside the relief.
  const ColourImage& Picture(int most_pixels = kMostPixels) const;

 private:
  struct Level {
    ColourImage picture;
    int factor = 1;
  };
  const Level& LevelOf(int most_pixels) const;

  std::vector<Level> levels_;  // largest first
};

}  // namespace arthro::authoring
