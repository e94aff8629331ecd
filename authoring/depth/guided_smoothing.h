// Smoothing that keeps edges, over the pixels that count: the guided filter [He, Sun & Tang 2013]
// with the picture as its own guide. Where a window varies by much less than `edge` it becomes its
// mean; where by much more, it stays as it is.
#pragma once

#include <opencv2/core.hpp>

namespace arthro::authoring {

// Mean over a square window of the pixels with weight 1 (`weight` CV_32F, 0 or 1); 0 where there is
// none.
cv::Mat WeightedMean(const cv::Mat& values, const cv::Mat& weight, int radius);

// The same with a bell of standard deviation `sigma`.
cv::Mat WeightedBlur(const cv::Mat& values, const cv::Mat& weight, double sigma);

// `values` CV_32F, positive; `edge` is the share of the local mean that a variation must have to be
// kept, above the noise of standard deviation `noise`. Radius 0 leaves all as it is.
cv::Mat GuidedSmoothing(const cv::Mat& values, const cv::Mat& weight, int radius, double edge,
                        double noise);

// Standard deviation of the finest variation, from second differences along the rows.
double NoiseOf(const cv::Mat& values, const cv::Mat& weight);

}  // namespace arthro::authoring
