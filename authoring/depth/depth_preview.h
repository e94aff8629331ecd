// The depth filter at interactive speed: the same filter on a smaller level of the panorama's
// pyramid, with pixel options scaled to it.
#pragma once

#include <vector>

#include "authoring/depth/depth_filter.h"

namespace arthro::authoring {

class DepthPreview {
 public:
  // Number of pixels that one core filters well within a frame.
  static constexpr int kMostPixels = 1 << 18;

  // Halves the panorama until few pixels are left. Highlights and surround do not bleed into the
  // averages.
  explicit DepthPreview(const ColourImage& panorama);

  // Relief on the largest level of at most `most_pixels` pixels, or on the smallest level.
  // `marks`: one per pixel of that level, or none.
  DepthMap Filter(const DepthOptions& options, DepthReport* report = nullptr,
                  int most_pixels = kMostPixels, std::span<const DepthMark> marks = {}) const;

  // Number of the panorama's pixels per pixel of that level, along a side; pixel (x, y) of the
  // level covers x*factor … x*factor + factor-1.
  int Factor(int most_pixels = kMostPixels) const;

  // Colours of that level, to show beside the relief.
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
