// A frame at the resolution of the decisions: one colour for each cell of the panorama that it
// shows.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/layout.h"

namespace arthro::authoring {

// Number of steps per grey level; 16 bits leave room above 255.
constexpr double kGreySteps = 100.0;

struct FrameCells {
  cv::Mat colour;        // CV_16UC3, grey level times kGreySteps, mean over the cell
  cv::Mat blend_weight;  // CV_8UC1, blend weight: 255 for a good view of the whole cell, 0 for none
  bool is_seen() const { return !blend_weight.empty(); }
};

// Ray of a cell in the frame: by the inverse homography, or over a surface within the frame's box.
class CellRays {
 public:
  CellRays(const LaidFrame& frame, int cell, const RectifiedView& view);
  struct Ray {
    double x, y;       // tan of the angle off the optical axis, right and down
    double w;          // the homography's denominator, proportional to the distance along the axis;
                       // over a surface its incident light
    double sharpness;  // raw px per panorama px, approximate; 1 on the axis of a frame drawn at
                       // scale 1
  };
  Ray At(int column, int row) const;  // the cell in the panorama's grid

 private:
  cv::Matx33d rectified_from_cell_, composed_from_rectified_;
  RectifiedView view_;
  double det_;
  SurfacePlace surface_;
  cv::Point first_;  // the box's first cell
};

// Masks overexposure and highlights: CV_8UC1, 255 at tissue.
cv::Mat TissueMask(const cv::Mat& rectified_rgb, const cv::Mat& lens_mask);

FrameCells CellsOf(const cv::Mat& rectified_rgb, const cv::Mat& tissue_mask,
                   const cv::Mat& lens_mask, const LaidFrame& frame, int cell);

}  // namespace arthro::authoring
