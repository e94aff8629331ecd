// SURF [Bay, Ess, Tuytelaars & Van Gool 2008], the paper's detector, implemented by dlib.
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
  cv::Mat descriptors;            // CV_32F, 64 columns, one row per point
};

// `grey` CV_8UC1. Returns at most `most` points inside `mask` (CV_8UC1), ordered by strength, all
// with a Hessian response of at least `least` (dlib's).
SurfPoints DetectSurf(const cv::Mat& grey, const cv::Mat& mask, int most, double least);

}  // namespace arthro::authoring
