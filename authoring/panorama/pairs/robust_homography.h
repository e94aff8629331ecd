// Homography with the most agreement among matches, or the reason for its absence. Samples of two
// matches give similarities, which need few inliers. The best are extended to affine maps and
// homographies, each kept only when the matches justify its parameters [Torr 1998]. The result is
// degenerate unless the matches spread in two directions. Solved in normalised coordinates [Hartley
// 1997], so that the unit does not matter.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/feature_options.h"

namespace arthro::authoring {

enum class PlaneMap { kSimilarity, kAffine, kHomography };

struct RobustHomography {
  bool is_found = false;
  std::string why_not;  // reason without a result
  cv::Matx33d b_from_a = cv::Matx33d::eye();
  PlaneMap kind = PlaneMap::kSimilarity;
  std::vector<int> inliers;  // indices of matches, ascending
  double rms = 0;            // inliers in b
};

// `a` and `b`: matched points, one to one. `options.max_error` is in the unit of the points;
// `reach` is half the window's extent.
RobustHomography FindHomography(const std::vector<cv::Point2d>& a,
                                const std::vector<cv::Point2d>& b, double reach,
                                const FeatureOptions& options);

// Least-squares fit of one kind of map to all points, on the distance in b; a homography by
// Gauss-Newton from the affine map. Returns false when the points do not determine it.
bool FitPlaneMap(PlaneMap kind, const std::vector<cv::Point2d>& a,
                 const std::vector<cv::Point2d>& b, cv::Matx33d& b_from_a);

// Derivative d(b)/d(h00 … h21) of a homography with h22 = 1, at a point of a.
cv::Matx<double, 2, 8> PointByHomography(const cv::Matx33d& b_from_a, const cv::Point2d& a);

}  // namespace arthro::authoring
