#include "authoring/lens/fit/board_pose.h"

#include <cmath>

#include <Eigen/Dense>

namespace arthro::authoring {

std::optional<BoardPose> PoseFromRays(std::span<const BoardRay> rays) {
  if (rays.size() < 4) return std::nullopt;
  // Coordinates relative to their mean, scaled to unit size for a well-conditioned system.
  Eigen::Vector2d middle(0, 0);
  for (const BoardRay& at : rays) middle += Eigen::Vector2d(at.on_board.x, at.on_board.y);
  middle /= static_cast<double>(rays.size());
  double spread = 0;
  for (const BoardRay& at : rays)
    spread += (Eigen::Vector2d(at.on_board.x, at.on_board.y) - middle).norm();
  spread /= static_cast<double>(rays.size());
  if (!(spread > 0)) return std::nullopt;
  // ray × (H X) = 0: normal matrix of three rows per point, two of which are independent.
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const BoardRay& at : rays) {
    const Eigen::Vector3d x((at.on_board.x - middle.x()) / spread,
                            (at.on_board.y - middle.y()) / spread, 1);
    const Eigen::Vector3d b(at.ray[0], at.ray[1], at.ray[2]);
    // |b × Hx|² = hᵀ (P ⊗ x xᵀ) h with P = I - b bᵀ and h the rows of H.
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - b * b.transpose();
    const Eigen::Matrix3d outer = x * x.transpose();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) normal.block<3, 3>(3 * r, 3 * c) += across(r, c) * outer;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const auto& values = solver.eigenvalues();
  if (!(values[1] > 1e-12 * values[8])) return std::nullopt;  // more than one solution
  Eigen::Matrix3d h;
  for (int r = 0; r < 3; ++r) h.row(r) = solver.eigenvectors().col(0).segment<3>(3 * r).transpose();
  // The board lies along its rays, not behind them.
  double ahead = 0;
  for (const BoardRay& at : rays)
    ahead += Eigen::Vector3d(at.ray[0], at.ray[1], at.ray[2])
                 .dot(h * Eigen::Vector3d((at.on_board.x - middle.x()) / spread,
                                          (at.on_board.y - middle.y()) / spread, 1));
  if (ahead < 0) h = -h;
  // Scales columns to unit mean length, takes the nearest rotation, and converts back to steps.
  h /= 0.5 * (h.col(0).norm() + h.col(1).norm());
  Eigen::Matrix3d raw;
  raw << h.col(0), h.col(1), h.col(0).cross(h.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(raw, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0) return std::nullopt;
  const Eigen::AngleAxisd axis(turn);
  const Eigen::Vector3d w = axis.angle() * axis.axis();
  const Eigen::Vector3d t = spread * h.col(2) - turn * Eigen::Vector3d(middle.x(), middle.y(), 0);
  if (!w.allFinite() || !t.allFinite()) return std::nullopt;
  return BoardPose{w.x(), w.y(), w.z(), t.x(), t.y(), t.z()};
}

}  // namespace arthro::authoring
