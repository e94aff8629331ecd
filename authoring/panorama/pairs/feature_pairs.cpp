#include "authoring/panorama/pairs/feature_pairs.h"

#include <algorithm>
#include <cmath>

#include "authoring/panorama/pairs/robust_homography.h"

namespace arthro::authoring {
namespace {

constexpr double kLeastNoise = 0.3;  // px: lower bound for any detector's accuracy at half scale

// Corners of the bounding box of the inliers, moved inwards to the points.
FourPoints ControlOf(const std::vector<cv::Point2d>& points) {
  cv::Point2d low = points.front(), high = low;
  for (const auto& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const cv::Point2d middle = 0.5 * (low + high), half = 0.35 * (high - low);
  return {middle - half,
          {middle.x + half.x, middle.y - half.y},
          middle + half,
          {middle.x - half.x, middle.y + half.y}};
}

}  // namespace

std::optional<PairEstimate> MatchFeatures(const FrameFeatures& a, const FrameFeatures& b, int ia,
                                          int ib, const FeatureOptions& options,
                                          std::string* why_not,
                                          const cv::Matx33d* predicted_b_from_a) {
  std::vector<cv::Point2d> in_a, in_b;
  for (const FeatureMatch& match : MutualMatches(a, b, options, predicted_b_from_a)) {
    in_a.push_back(a.points()[static_cast<std::size_t>(match.a)]);
    in_b.push_back(b.points()[static_cast<std::size_t>(match.b)]);
  }
  FeatureOptions own = options;  // each pair draws its own samples
  own.seed = options.seed + 7919 * ia + 104729 * ib;
  const RobustHomography found = FindHomography(in_a, in_b, a.reach(), own);
  if (!found.is_found) {
    if (why_not) *why_not = found.why_not;
    return std::nullopt;
  }

  PairEstimate pair;
  pair.a = ia;
  pair.b = ib;
  pair.source = PairSource::kFeatures;
  pair.b_from_a = found.b_from_a;
  pair.inliers = static_cast<int>(found.inliers.size());
  pair.rms_px = found.rms;
  std::vector<cv::Point2d> inliers;
  for (const int i : found.inliers) inliers.push_back(in_a[static_cast<std::size_t>(i)]);
  pair.control_in_a = ControlOf(inliers);

  // Coordinates relative to the middle of the inliers, in units of their extent, for
  // well-conditioned normal equations. Computes the information of the homography there, then of
  // the control points.
  const cv::Point2d middle = 0.5 * (pair.control_in_a[0] + pair.control_in_a[2]);
  const double extent = std::max(1e-9, cv::norm(pair.control_in_a[2] - middle));
  const cv::Matx33d a_from_unit(extent, 0, middle.x, 0, extent, middle.y, 0, 0, 1);
  const auto unit = [&](const cv::Point2d& p) { return (p - middle) * (1 / extent); };
  cv::Matx33d b_from_unit = pair.b_from_a * a_from_unit;
  b_from_unit *= 1 / b_from_unit(2, 2);
  cv::Matx<double, 8, 8> information = cv::Matx<double, 8, 8>::zeros();
  for (const auto& p : inliers) {
    const auto j = PointByHomography(b_from_unit, unit(p));
    information += j.t() * j;
  }
  cv::Matx<double, 8, 8> control_by_homography;
  for (int k = 0; k < 4; ++k) {
    const auto j =
        PointByHomography(b_from_unit, unit(pair.control_in_a[static_cast<std::size_t>(k)]));
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 8; ++column)
        control_by_homography(2 * k + row, column) = j(row, column);
  }
  // Degrees of freedom along one axis of the residual; eight of the 2n were fitted.
  const double free = std::max(1.0, 2.0 * pair.inliers - 8.0);
  const double variance =
      std::max(kLeastNoise * kLeastNoise, found.rms * found.rms * pair.inliers / free);
  const auto homography_by_control = control_by_homography.inv();
  information = homography_by_control.t() * information * homography_by_control * (1 / variance);
  pair.information = (information + information.t()) * 0.5;
  return pair;
}

}  // namespace arthro::authoring
