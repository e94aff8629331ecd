// SURF [Bay, Ess, Tuytelaars & Van Gool 2008], the paper's detector, as dlib has it.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

struct SurfPoint {
  cv::Point2f at;  // px of the picture
  float scale = 0, strength = 0;
};

struct SurfPoints {
  std::vector<SurfPoint> points;  // strongest first
  cv::Mat descriptors;            // CV_32F, 64 columns, one row a point
};

// `grey` CV_8UC1. At most `most` points inside `mask` (CV_8UC1), ordered by strength; below `least`
// of dlib's Hessian response nothing is a point.
SurfPoints DetectSurf(const cv::Mat& grey, const cv::Mat& mask, int most, double least);

}  // namespace arthro::authoring
