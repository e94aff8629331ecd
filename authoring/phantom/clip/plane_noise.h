// Smooth noise over a rectangle of the plane, from a seed; as many octaves as wanted.
#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

#include "authoring/phantom/noise.h"

namespace arthro::authoring {

// A standard normal value from 12 random bits: quantiles in a table.
float NormalOf(std::uint64_t bits);

struct NoiseShape {
  double cell = 10;    // px: size of the largest features
  int octaves = 3;     // each twice as fine…
  double gain = 0.55;  // …and this much as strong
  double stretch = 1;  // features are so much longer along x
};

// CV_32F of `size`, unit variance or so.
cv::Mat PlaneNoise(cv::Size size, const NoiseShape& shape, Random& random);

// Branching vessels drawn as CV_32F, 0 to 1, with widths of up to `thickness` px.
cv::Mat VesselsOnPlane(cv::Size size, int count, double thickness, double scale, Random& random);

}  // namespace arthro::authoring
