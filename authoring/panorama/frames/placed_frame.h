// Position of a frame: the result of registration, the input of composition, a row of the report.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct FrameResult {
  int index = 0;  // in the footage
  bool is_placed = false;
  std::string reason;  // why it is not placed; empty for a placed frame
  int component = -1;  // 0: the panorama; 1…: a separate piece; -1: none
  cv::Matx33d panorama_from_rectified = cv::Matx33d::eye();  // in its component
  int inliers = 0;
  double rms_px = 0;
  double expected_error_px = 0;  // worst of nine points: the centre and eight at 85 % of the circle
};

}  // namespace arthro::authoring
