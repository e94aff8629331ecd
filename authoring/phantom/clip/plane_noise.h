// Smooth noise over a rectangle of the plane, from a seed, with any number of octaves.
#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

#include "authoring/phantom/shape/noise.h"

namespace arthro::authoring {

// Standard normal value from 12 random bits, by a table of quantiles.
float NormalOf(std::uint64_t bits);

struct NoiseShape {
  double cell = 10;    // px: size of the largest features
  int octaves = 3;     // each with half the cell of the one before
  double gain = 0.55;  // factor on the amplitude from one octave to the next
  double stretch = 1;  // elongation of features along x
};

// CV_32F of `size`, with about unit variance.
cv::Mat PlaneNoise(cv::Size size, const NoiseShape& shape, Random& random);

// Branching vessels drawn as CV_32F, 0 to 1, with widths of up to `thickness` px.
cv::Mat VesselsOnPlane(cv::Size size, int count, double thickness, double scale, Random& random);

}  // namespace arthro::authoring
