// The homography that most of some matches agree on, or why there is none. Samples of two matches
// give similarities, which need few inliers; the best are widened to affine maps and homographies,
// each kept only where the matches pay for its parameters [Torr 1998]; what is left is degenerate
// unless the matches spread in two directions. Solved in normalised coordinates [Hartley 1997], so
// that the unit does not matter.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/feature_options.h"

namespace arthro::authoring {

enum class PlaneMap { kSimilarity, kAffine, kHomography };

struct RobustHomography {
  bool is_found = false;
  std::string why_not;  // when it is not
  cv::Matx33d b_from_a = cv::Matx33d::eye();
  PlaneMap kind = PlaneMap::kSimilarity;
  std::vector<int> inliers;  // indices of matches, ascending
  double rms = 0;            // of the inliers in b
};

// `a` and `b`: matched points, one to one. `options.max_error` is in the unit of the points;
// `reach` is half the window's extent.
RobustHomography FindHomography(const std::vector<cv::Point2d>& a,
                                const std::vector<cv::Point2d>& b, double reach,
                                const FeatureOptions& options);

// Least squares of one kind over all points, on the distance in b; a homography by Gauss-Newton
// from the affine map. False when the points do not determine it.
bool FitPlaneMap(PlaneMap kind, const std::vector<cv::Point2d>& a,
                 const std::vector<cv::Point2d>& b, cv::Matx33d& b_from_a);

// d(b)/d(h00 … h21) of a homography with h22 = 1, at a point of a.
cv::Matx<double, 2, 8> PointByHomography(const cv::Matx33d& b_from_a, const cv::Point2d& a);

}  // namespace arthro::authoring
