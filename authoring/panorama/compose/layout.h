// Where each frame lies in the panorama: its size, its scale, and which frames do not belong in it.
//
// A cell (i, j) of the grid covers panorama px [i c, (i+1) c) x [j c, (j+1) c), c the cell's width,
// so that x_cell = (x + 0.5) / c - 0.5, as cv::resize has it.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/compose.h"

namespace arthro::authoring {

struct LaidFrame {
  int index = 0;                        // in the footage
  cv::Matx33d composed_from_rectified;  // panorama px; its last row is positive on the frame
  std::vector<cv::Point2d> outline;     // of what the lens shows, panorama px
  cv::Rect cells;                       // box in cells that holds the outline
  double trust = 1;                     // falls with the expected error of its place
};

struct Layout {
  cv::Size size;   // of the panorama, px; empty: no frame
  cv::Size cells;  // of the grid, rounded up
  int cell = 0;    // width of a cell, px
  double scale = 1;
  cv::Matx33d composed_from_panorama = cv::Matx33d::eye();
  RectifiedView view;             // the panorama as the picture of a pinhole camera
  std::vector<LaidFrame> frames;  // by index
  std::vector<FrameLeftOut> left_out;
};

// `mask` is the rectifier's, CV_8UC1, and `view` its view.
Layout LayOut(const cv::Mat& mask, const RectifiedView& view,
              const std::vector<FrameResult>& frames, const ComposeOptions& options);

}  // namespace arthro::authoring
