// Edge-preserving smoothing over the pixels that count: the guided filter [He, Sun & Tang 2013]
// with the picture as its own guide. A window that varies by much less than `edge` becomes its
// mean; a window that varies by much more stays unchanged.
#pragma once

#include <opencv2/core.hpp>

namespace arthro::authoring {

// Mean over a square window of the pixels with weight 1 (`weight` CV_32F, 0 or 1); 0 without any.
cv::Mat WeightedMean(const cv::Mat& values, const cv::Mat& weight, int radius);

// The same with a Gaussian window of standard deviation `sigma`.
cv::Mat WeightedBlur(const cv::Mat& values, const cv::Mat& weight, double sigma);

// Smooths `values` (CV_32F, positive). A variation is kept when it exceeds the share `edge` of the
// local mean, above the noise of standard deviation `noise`. Radius 0 changes nothing.
cv::Mat GuidedSmoothing(const cv::Mat& values, const cv::Mat& weight, int radius, double edge,
                        double noise);

// Standard deviation of the finest variation, from second differences along the rows.
double NoiseOf(const cv::Mat& values, const cv::Mat& weight);

}  // namespace arthro::authoring
