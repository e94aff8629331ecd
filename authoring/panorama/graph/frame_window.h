// The round part of a rectified frame that shows something, and the nine points of it at which a
// frame's error counts: the centre and eight at 85 % of the window's radius in the raw picture.
// Rectified px at scale 1.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"

namespace arthro::authoring {

struct FrameWindow {
  cv::Point2d centre;
  double radius = 0;
  std::vector<cv::Point2d> nine;  // the centre first
  std::vector<cv::Point2d> grid;  // evenly over the window, for overlaps
};

// `mask` at scale 1 or any other; where it is empty the whole view counts.
FrameWindow WindowOf(const RectifiedView& view, const cv::Mat& mask);

// Share of the window of a that the window of b shows; 0 when b looks at it from behind.
double OverlapOf(const FrameWindow& window, const cv::Matx33d& b_from_a);

}  // namespace arthro::authoring
