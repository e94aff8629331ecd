// Where a frame ended up: the result of registration, the input of composition, the report's row.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct FrameResult {
  int index = 0;  // in the footage
  bool is_placed = false;
  std::string reason;  // why not; empty when placed
  int component = -1;  // 0: the panorama; 1…: a separate piece that does not join; -1: none
  cv::Matx33d panorama_from_rectified = cv::Matx33d::eye();  // within its component
  int inliers = 0;
  double rms_px = 0;
  double expected_error_px =
      0;  // of the worst of nine points, centre and eight at 85 % of the circle
};

}  // namespace arthro::authoring
