// Visible round part of a rectified frame, and the nine points at which a frame's error is
// measured: the centre and eight at 85 % of the window's radius in the raw picture. Rectified px at
// scale 1.
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

// `mask` at scale 1 or any other; an empty mask means the whole view.
FrameWindow WindowOf(const RectifiedView& view, const cv::Mat& mask);

// Share of the window of a that lies in the window of b; 0 when b sees it from behind.
double OverlapOf(const FrameWindow& window, const cv::Matx33d& b_from_a);

}  // namespace arthro::authoring
