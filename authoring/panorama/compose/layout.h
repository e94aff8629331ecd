// Layout of the frames in the panorama: its size, its scale, and the frames that are left out.
//
// A cell (i, j) of the grid covers panorama px [i c, (i+1) c) x [j c, (j+1) c), c the cell's width,
// so that x_cell = (x + 0.5) / c - 0.5, as in cv::resize.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/compose.h"

namespace arthro::authoring {

struct LaidFrame {
  int index = 0;                        // in the footage
  cv::Matx33d composed_from_rectified;  // panorama px; its last row is positive on the frame
  std::vector<cv::Point2d> outline;     // outline of the lens's visible area, panorama px
  cv::Rect cells;                       // box in cells that holds the outline
  double trust = 1;  // weight, which falls with the expected error of the position
};

struct Layout {
  cv::Size size;   // panorama, px; empty: no frame
  cv::Size cells;  // size of the grid, rounded up
  int cell = 0;    // width of a cell, px
  double scale = 1;
  cv::Matx33d composed_from_panorama = cv::Matx33d::eye();
  RectifiedView view;             // the panorama as the picture of a pinhole camera
  std::vector<LaidFrame> frames;  // in the order of their index
  std::vector<FrameLeftOut> left_out;
};

// `mask` is the rectifier's, CV_8UC1, and `view` its view.
Layout LayOut(const cv::Mat& mask, const RectifiedView& view,
              const std::vector<FrameResult>& frames, const ComposeOptions& options);

}  // namespace arthro::authoring
