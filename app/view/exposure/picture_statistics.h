// Statistics by which a drawn picture is compared with frames of a real endoscope [method.md,
// Statistics of a picture]. Plain values, no OpenGL. Grey is the luma of stored colours [ITU-R
// BT.601], 0 to 255.
#pragma once

#include <span>
#include <vector>

#include "simulation/scene/image.h"

namespace arthro::app {

// Pixels that count; at least two rows and columns of the picture.
struct PictureMask {
  int width = 0, height = 0;
  std::vector<bool> counts;
  bool at(int x, int y) const {
    return counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};
// Disc of `radius` px about a centre, within a picture.
PictureMask DiscMask(int width, int height, double centre_x, double centre_y, double radius);

struct PictureStatistics {
  double p1 = 0, p50 = 0, p99 = 0;  // percentiles of grey
  double clipped = 0, black = 0;    // shares: largest channel at least 250; grey at most 5
  double gradient = 0;              // mean of the gradient along x and along y, grey levels per px
  double flat = 0;                  // share whose gradient is at most half a grey level per px
  double chroma = 0;                // rms distance of (Cb, Cr) from their mean
  int pictures = 0;                 // number of pictures in the means; 0: nothing was measured
};

// Side of the picture, or diameter of the window, at which gradients are comparable, px.
inline constexpr int kStatisticsSize = 512;
// Share of the window's radius that is measured: the rim is dark by its optics.
inline constexpr double kMeasuredRadius = 0.9;

// Returns 0 pictures where nothing counts.
PictureStatistics MeasurePicture(const ColourImage& picture, const PictureMask& mask);

// Returns the mean of each statistic over the pictures.
PictureStatistics MeanOf(std::span<const PictureStatistics> pictures);

}  // namespace arthro::app
