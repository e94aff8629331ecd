#include "authoring/panorama/graph/refinement/pair_term.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace arthro::authoring {
namespace {

Eigen::Matrix3d ToEigen(const cv::Matx33d& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.val);
}

// Computes W with W^T W = (information^-1 + floor^2 I)^-1, also for singular information.
Matrix8 WhiteningOf(const cv::Matx<double, 8, 8>& information, double floor_px) {
  Matrix8 raw = Eigen::Map<const Eigen::Matrix<double, 8, 8, Eigen::RowMajor>>(information.val);
  raw = 0.5 * (raw + raw.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Matrix8> eigen(raw);
  Vector8 root;
  for (int i = 0; i < 8; ++i) {
    const double value = std::max(0.0, eigen.eigenvalues()[i]);
    root[i] = std::sqrt(value / (1.0 + value * floor_px * floor_px));
  }
  return root.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

Eigen::Matrix3d Normalisation::Normalise(const cv::Matx33d& homography) const {
  Eigen::Matrix3d to, from;
  to << 1 / scale, 0, -cx / scale, 0, 1 / scale, -cy / scale, 0, 0, 1;
  from << scale, 0, cx, 0, scale, cy, 0, 0, 1;
  const Eigen::Matrix3d m = to * ToEigen(homography) * from;
  return m / m.norm() * std::sqrt(3.0);
}

cv::Matx33d Normalisation::Denormalise(const Eigen::Matrix3d& homography) const {
  Eigen::Matrix3d to, from;
  to << 1 / scale, 0, -cx / scale, 0, 1 / scale, -cy / scale, 0, 0, 1;
  from << scale, 0, cx, 0, scale, cy, 0, 0, 1;
  Eigen::Matrix3d m = from * homography * to;
  m /= m(2, 2) != 0 ? m(2, 2) : 1.0;
  cv::Matx33d result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result(r, c) = m(r, c);
  return result;
}

Normalisation NormalisationOf(const std::vector<PairEstimate>& pairs) {
  Normalisation normalisation;
  if (pairs.empty()) return normalisation;
  const double count = 4.0 * static_cast<double>(pairs.size());
  for (const PairEstimate& pair : pairs)
    for (const cv::Point2d& c : pair.control_in_a) {
      normalisation.cx += c.x / count;
      normalisation.cy += c.y / count;
    }
  double square = 0;
  for (const PairEstimate& pair : pairs)
    for (const cv::Point2d& c : pair.control_in_a) {
      const double x = c.x - normalisation.cx, y = c.y - normalisation.cy;
      square += (x * x + y * y) / count;
    }
  if (square > 0) normalisation.scale = std::sqrt(square);
  return normalisation;
}

PairTerm::PairTerm(const PairEstimate& pair, const Normalisation& normalisation, double floor_px)
    : a_(pair.a),
      b_(pair.b),
      scale_(normalisation.scale),
      whiten_(WhiteningOf(pair.information, floor_px)) {
  const Eigen::Matrix3d b_from_a = normalisation.Normalise(pair.b_from_a);
  for (int k = 0; k < 4; ++k) {
    control_.col(k) = normalisation.Normalise(pair.control_in_a[static_cast<std::size_t>(k)]);
    const Eigen::Vector3d target = b_from_a * control_.col(k);
    target_.col(k) = target / target.z();
  }
}

bool PairTerm::Evaluate(const Eigen::Matrix3d& plane_from_a, const Eigen::Matrix3d& plane_from_b,
                        const Eigen::Matrix3d& plane_from_a0, const Eigen::Matrix3d& plane_from_b0,
                        Vector8* whitened, Vector8* px, Matrix8* by_a, Matrix8* by_b) const {
  const Eigen::Matrix3d b_from_plane = plane_from_b.inverse();
  const Eigen::Matrix3d b_from_a = b_from_plane * plane_from_a;
  const Eigen::Matrix3d b_from_a0 = b_from_plane * plane_from_a0;
  const Eigen::Matrix3d b_from_b0 = b_from_plane * plane_from_b0;
  if (!b_from_a.allFinite()) return false;
  // The sign of a homography is free; its determinant tells the side of the points.
  const double side = b_from_a.determinant() > 0 ? 1.0 : -1.0;
  Vector8 error;
  Matrix8 da, db;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d p = b_from_a * control_.col(k);
    if (!(p.z() * side > 1e-6 * p.norm())) return false;
    error.segment<2>(2 * k) = (p.head<2>() / p.z() - target_.col(k).head<2>()) * scale_;
    if (by_a) da.middleRows<2>(2 * k) = ChartDerivative(b_from_a0, control_.col(k), p) * scale_;
    // d inv(M_b) = -inv(M_b) dM_b inv(M_b)
    if (by_b) db.middleRows<2>(2 * k) = -ChartDerivative(b_from_b0, p, p) * scale_;
  }
  if (px) *px = error;
  if (whitened) *whitened = whiten_ * error;
  if (by_a) *by_a = whiten_ * da;
  if (by_b) *by_b = whiten_ * db;
  return error.allFinite();
}

Eigen::Matrix3d MoveInChart(const Eigen::Matrix3d& start, const Vector8& x) {
  Eigen::Matrix3d step;
  step << 1 + x[0], x[1], x[2], x[3], 1 + x[4], x[5], x[6], x[7], 1;
  return start * step;
}

Eigen::Matrix<double, 2, 8> ChartDerivative(const Eigen::Matrix3d& h, const Eigen::Vector3d& y,
                                            const Eigen::Vector3d& p) {
  // Derivative of pi at p, times h, times dA y: columns of A select the entries of y.
  Eigen::Matrix<double, 2, 3> projection;
  projection << 1 / p.z(), 0, -p.x() / (p.z() * p.z()), 0, 1 / p.z(), -p.y() / (p.z() * p.z());
  const Eigen::Matrix<double, 2, 3> m = projection * h;
  Eigen::Matrix<double, 2, 8> d;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3 && row * 3 + col < 8; ++col)
      d.col(row * 3 + col) = m.col(row) * y[col];
  return d;
}

}  // namespace arthro::authoring
