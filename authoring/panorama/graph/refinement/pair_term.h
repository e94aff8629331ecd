// Residual of one pair in the refinement, with its derivatives.
//
// Every frame has M, plane_from_frame, in normalised coordinates: pixels shifted and scaled so that
// the control points have mean 0 and rms radius 1. Solves then do not depend on the pixel's size
// [Hartley 1997]. Around a start M0 a frame moves in the chart M = M0 (I + A(x)),
//   A(x) = (x0 x1 x2; x3 x4 x5; x6 x7 0).
// Residual in frame b, px: e_k = pi(inv(M_b) M_a c_k) - pi(b_from_a c_k) over the four control
// points c_k, whitened by L^T, where L L^T is the information of the pair.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

struct Normalisation {
  double cx = 0, cy = 0, scale = 1;  // px; normalised = (px - c) / scale

  Eigen::Vector3d Normalise(const cv::Point2d& pixel) const {
    return {(pixel.x - cx) / scale, (pixel.y - cy) / scale, 1.0};
  }
  Eigen::Matrix3d Normalise(const cv::Matx33d& homography) const;
  cv::Matx33d Denormalise(const Eigen::Matrix3d& homography) const;
};

Normalisation NormalisationOf(const std::vector<PairEstimate>& pairs);

class PairTerm {
 public:
  // `floor_px`: least error of every pair (light, lens, relief), as a standard deviation of each
  // coordinate; added to the pair's own covariance.
  PairTerm(const PairEstimate& pair, const Normalisation& normalisation, double floor_px);

  int a() const { return a_; }
  int b() const { return b_; }

  // Returns false when a control point falls behind frame b. `plane_from_x0` are the charts'
  // origins. Jacobians may be null.
  bool Evaluate(const Eigen::Matrix3d& plane_from_a, const Eigen::Matrix3d& plane_from_b,
                const Eigen::Matrix3d& plane_from_a0, const Eigen::Matrix3d& plane_from_b0,
                Vector8* whitened, Vector8* px, Matrix8* by_a, Matrix8* by_b) const;

 private:
  int a_ = 0, b_ = 0;
  double scale_ = 1;  // px per normalised unit
  Eigen::Matrix<double, 3, 4> control_, target_;
  Matrix8 whiten_;
};

// M0 (I + A(x)).
Eigen::Matrix3d MoveInChart(const Eigen::Matrix3d& start, const Vector8& x);

// Derivative of pi(h A(x) y) by x at a homogeneous point p = h y: 2 x 8.
Eigen::Matrix<double, 2, 8> ChartDerivative(const Eigen::Matrix3d& h, const Eigen::Vector3d& y,
                                            const Eigen::Vector3d& p);

}  // namespace arthro::authoring
