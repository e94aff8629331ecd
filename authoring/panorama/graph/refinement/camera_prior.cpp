#include "authoring/panorama/graph/refinement/camera_prior.h"

#include <cmath>

#include <Eigen/LU>

namespace arthro::authoring {

CameraPrior::CameraPrior(const Pinhole& camera, const Normalisation& normalisation,
                         double deviation)
    : weight_(1 / deviation) {
  Eigen::Matrix3d frame_from_ray;
  frame_from_ray << camera.focal_px / normalisation.scale, 0,
      (camera.cx - normalisation.cx) / normalisation.scale, 0,
      camera.focal_px / normalisation.scale, (camera.cy - normalisation.cy) / normalisation.scale,
      0, 0, 1;
  ray_from_frame_ = frame_from_ray.inverse();
}

bool CameraPrior::Evaluate(const Eigen::Matrix3d& place, const Eigen::Matrix3d& place0,
                           Eigen::Vector2d* residual, Eigen::Matrix<double, 2, 8>* by_frame) const {
  const Eigen::Matrix3d frame_from_plane = place.inverse();
  const Eigen::Matrix3d g = ray_from_frame_ * frame_from_plane;
  if (!g.allFinite()) return false;
  const Eigen::Vector3d a = g.col(0), b = g.col(1);
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b), sum = aa + bb;
  if (!(sum > 0)) return false;
  const double first = (aa - bb) / sum, second = 2 * ab / sum;
  *residual = weight_ * Eigen::Vector2d(first, second);
  if (by_frame == nullptr) return true;
  // Differential dG = -G0 E G', with G0 = inv(K) inv(M) M0 and G' = inv(M).
  const Eigen::Matrix3d g0 = g * place0;
  for (int j = 0; j < 8; ++j) {
    const int row = j / 3, col = j % 3;
    const Eigen::Vector3d da = -g0.col(row) * frame_from_plane(col, 0);
    const Eigen::Vector3d db = -g0.col(row) * frame_from_plane(col, 1);
    const double daa = 2 * a.dot(da), dbb = 2 * b.dot(db), dab = a.dot(db) + b.dot(da);
    (*by_frame)(0, j) = weight_ * (daa - dbb - first * (daa + dbb)) / sum;
    (*by_frame)(1, j) = weight_ * (2 * dab - second * (daa + dbb)) / sum;
  }
  return true;
}

}  // namespace arthro::authoring
