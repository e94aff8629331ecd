// Prior from a calibrated scope. A rectified frame is a pinhole picture with known K. For a plane,
// or for any scene that it only rotates in, G = inv(K) inv(M), M being plane_from_frame in a plane
// with a straight metric. The first two columns g1, g2 of G are those of a rotation and a scale:
//   (|g1|^2 - |g2|^2) / (|g1|^2 + |g2|^2) = 0,   2 g1.g2 / (|g1|^2 + |g2|^2) = 0    [Zhang 2000]
// Two of a homography's eight numbers are thereby not free: the two that cause perspective drift in
// a chain of frames. Relief violates the rule a little, so it is a prior with a deviation.
#pragma once

#include <Eigen/Core>

#include "authoring/panorama/graph/refinement/pair_term.h"
#include "authoring/panorama/graph/refinement/pinhole.h"

namespace arthro::authoring {

class CameraPrior {
 public:
  CameraPrior(const Pinhole& camera, const Normalisation& normalisation, double deviation);

  // `place` and its chart's origin `place0`, normalised (pair_term.h). Returns false at a
  // singularity.
  bool Evaluate(const Eigen::Matrix3d& place, const Eigen::Matrix3d& place0,
                Eigen::Vector2d* residual, Eigen::Matrix<double, 2, 8>* by_frame) const;

 private:
  Eigen::Matrix3d ray_from_frame_;
  double weight_ = 0;
};

}  // namespace arthro::authoring
