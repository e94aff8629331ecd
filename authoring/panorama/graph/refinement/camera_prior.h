// What a calibrated scope adds to the refinement. A rectified frame is a pinhole picture with known
// K, so a plane seen by it, or any scene that it only turns in, has G = inv(K) inv(M), M being
// plane_from_frame in a plane with a straight metric, whose first two columns g1, g2 are those of a
// turn and a zoom:
//   (|g1|^2 - |g2|^2) / (|g1|^2 + |g2|^2) = 0,   2 g1.g2 / (|g1|^2 + |g2|^2) = 0    [Zhang 2000]
// Two of a homography's eight numbers are not free, and those are the two that let a chain of
// frames bend: perspective drift. Relief breaks the rule a little, so it is a prior with a
// deviation, not a law.
#pragma once

#include <Eigen/Core>

#include "authoring/panorama/graph/refinement/pair_term.h"
#include "authoring/panorama/graph/refinement/pinhole.h"

namespace arthro::authoring {

class CameraPrior {
 public:
  CameraPrior(const Pinhole& camera, const Normalisation& normalisation, double deviation);

  // `place` and its chart's origin `place0`, normalised (pair_term.h). False where it is singular.
  bool Evaluate(const Eigen::Matrix3d& place, const Eigen::Matrix3d& place0,
                Eigen::Vector2d* residual, Eigen::Matrix<double, 2, 8>* by_frame) const;

 private:
  Eigen::Matrix3d ray_from_frame_;
  double weight_ = 0;
};

}  // namespace arthro::authoring
