// Relative position of one pair of frames: a homography and its information. All in rectified
// pixels at scale 1.
//
// Four-point form [Baker, Datta & Kanade 2006]: a homography b_from_a near an estimate is the
// displacement d = (dx0, dy0, … dx3, dy3) of the images of four control points of frame a from
// their images under the estimate. It is well conditioned, linear near 0, in px. `information` is
// the inverse covariance of d.
#pragma once

#include <array>

#include <opencv2/core.hpp>

namespace arthro::authoring {

enum class PairSource { kFeatures, kDirect };

using FourPoints = std::array<cv::Point2d, 4>;

struct PairEstimate {
  int a = 0, b = 0;  // positions in the list of working frames
  PairSource source = PairSource::kFeatures;
  cv::Matx33d b_from_a;
  FourPoints control_in_a;             // near the overlap; spread wide
  cv::Matx<double, 8, 8> information;  // px^-2, symmetric, positive semi-definite
  int inliers = 0;                     // matches, or independent patches when direct
  double rms_px = 0;                   // residual of the inliers, frame b
  double overlap = 0;                  // share of frame a's mask that frame b shows
  double similarity = 0;               // correlation of the two evened-out greys there, -1 to 1
};

cv::Point2d Apply(const cv::Matx33d& homography, const cv::Point2d& point);

}  // namespace arthro::authoring
