// Layout of the frames in the panorama: its size, its scale, and the frames that are left out.
//
// A cell (i, j) of the grid covers panorama px [i c, (i+1) c) x [j c, (j+1) c), c the cell's width,
// so that x_cell = (x + 0.5) / c - 0.5, as in cv::resize.
#pragma once

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/compose.h"

namespace arthro::authoring {

// How a frame's picture falls on the panorama over a surface that is not flat: one entry per cell
// of the frame's box.
struct SurfacePlace {
  cv::Mat pixel;      // CV_32FC2, pixel of the frame's picture; finite everywhere
  cv::Mat is_shown;   // CV_8UC1, 255 where the frame shows the surface
  cv::Mat tangent;    // CV_32FC2, tan of the angle off the optical axis, right and down
  cv::Mat light;      // CV_32FC1, cosine of the incidence over the squared range
  cv::Mat sharpness;  // CV_32FC1, as in CellRays::Ray
  bool empty() const { return pixel.empty(); }
};

struct LaidFrame {
  int index = 0;                        // in the footage
  cv::Matx33d composed_from_rectified;  // panorama px; its last row is positive on the frame
  std::vector<cv::Point2d> outline;     // outline of the lens's visible area, panorama px
  cv::Rect cells;                       // box in cells that holds the outline
  double trust = 1;  // weight, which falls with the expected error of the position
  double expected_error_px = 0;
  SurfacePlace surface{};  // takes the place of homography and outline; empty: a plane
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

// The pictures that the frames of a layout lie by.
struct FramePicture {
  std::function<void(const cv::Mat& raw, cv::Mat& picture)> draw;
  cv::Mat mask;        // CV_8UC1, 255 where the lens shows something
  RectifiedView view;  // rays of a plane's pictures
};

// Composes frames that lie in the panorama already, as Compose does.
ComposedPanorama ComposeLayout(const FrameSource& source, const FramePicture& picture,
                               const Layout& layout, const ComposeOptions& options,
                               ComposeReport* report, const Progress& progress,
                               const ComposeObserver& observer = {});

// `mask` is the rectifier's, CV_8UC1, and `view` its view.
Layout LayOut(const cv::Mat& mask, const RectifiedView& view,
              const std::vector<FrameResult>& frames, const ComposeOptions& options);

}  // namespace arthro::authoring
