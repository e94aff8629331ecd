// Closes a measured surface: gives every cell a radius, a standard error and an origin. The
// logarithm x of the radius minimises
//   Σ (x - m)² / s²  +  Σ w (x_i - x_j)² / t²
// over measured cells and neighbours: a membrane whose tension 1/t² is that of the measured surface
// itself, cut (w near 0) where matching found a step. The standard error is the posterior one, so
// that it grows with the distance from what was measured.
#pragma once

#include <opencv2/core.hpp>

#include "simulation/core/progress.h"

namespace arthro::authoring {

// CV_32FC1, one size.
struct OpenSurface {
  cv::Mat matched;   // radius of best match, also where it is doubtful; NaN where there is none
  cv::Mat sigma;     // standard error of the cells that count as measured; NaN elsewhere
  cv::Mat estimate;  // radius from brightness, NaN where there is none; may be empty
  cv::Mat estimate_sigma;
};

struct ClosedSurface {
  cv::Mat radius, sigma;  // CV_32FC1, without holes; empty where nothing was measured
  cv::Mat origin;         // CV_8UC1 of ReliefOrigin
};

// Throws Error(kCancelled).
ClosedSurface CloseSurface(const OpenSurface& open, const Progress& progress = {});

}  // namespace arthro::authoring
