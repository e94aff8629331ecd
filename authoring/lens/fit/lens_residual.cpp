#include "authoring/lens/fit/lens_residual.h"

#include <cmath>

#include <Eigen/Dense>

namespace arthro::authoring {
namespace {

Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Rodrigues' formula, and the right Jacobian: R(w + d) ≈ R(w) R(right · d).
void Turn(const Eigen::Vector3d& w, Eigen::Matrix3d& turn, Eigen::Matrix3d* right) {
  const double angle2 = w.squaredNorm(), angle = std::sqrt(angle2);
  const Eigen::Matrix3d k = Cross(w), k2 = k * k;
  double a, b, c;  // sin φ/φ, (1 - cos φ)/φ², (φ - sin φ)/φ³
  if (angle < 1e-4) {
    a = 1 - angle2 / 6;
    b = 0.5 - angle2 / 24;
    c = 1.0 / 6 - angle2 / 120;
  } else {
    a = std::sin(angle) / angle;
    b = (1 - std::cos(angle)) / angle2;
    c = (1 - a) / angle2;
  }
  turn = Eigen::Matrix3d::Identity() + a * k + b * k2;
  if (right) *right = Eigen::Matrix3d::Identity() - b * k + c * k2;
}

}  // namespace

LensResidual::LensResidual(FitModel model, bool has_aspect, const cv::Point2d& on_board,
                           const cv::Point2d& pixel, double fixed_aspect)
    : model_(model),
      has_aspect_(has_aspect),
      on_board_(on_board),
      pixel_(pixel),
      fixed_aspect_(fixed_aspect) {
  set_num_residuals(2);
  mutable_parameter_block_sizes()->push_back(3 + (has_aspect ? 1 : 0) + OwnParametersOf(model));
  mutable_parameter_block_sizes()->push_back(6);
}

bool LensResidual::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  const double* lens = parameters[0];
  const double* pose = parameters[1];
  const int first_own = has_aspect_ ? 4 : 3, own = OwnParametersOf(model_);
  const double aspect = has_aspect_ ? lens[3] : fixed_aspect_;
  const bool wants_pose = jacobians && jacobians[1];
  const Eigen::Vector3d w(pose[0], pose[1], pose[2]), x(on_board_.x, on_board_.y, 0);
  Eigen::Matrix3d turn, right;
  Turn(w, turn, wants_pose ? &right : nullptr);
  const Eigen::Vector3d p = turn * x + Eigen::Vector3d(pose[3], pose[4], pose[5]);
  const double across2 = p.x() * p.x() + p.y() * p.y(), across = std::sqrt(across2);
  const double theta = std::atan2(across, p.z());
  RadialValue value;
  if (!(lens[0] > 0) || !(aspect > 0) || !(p.squaredNorm() > 1e-18) ||
      !EvaluateRadius(model_, lens[0], {lens + first_own, static_cast<std::size_t>(own)}, theta,
                      value))
    return false;
  // On the axis r/|across| becomes r'(0)/z.
  const bool on_axis = across < 1e-9 * std::abs(p.z());
  const double scale = on_axis ? value.by_theta / p.z() : value.r / across;
  residuals[0] = lens[1] + p.x() * scale - pixel_.x;
  residuals[1] = lens[2] + p.y() * scale / aspect - pixel_.y;
  if (!jacobians) return true;
  if (jacobians[0]) {
    const int columns = parameter_block_sizes()[0];
    Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>> j(jacobians[0], 2,
                                                                            columns);
    j.setZero();
    const double ux = on_axis ? 0 : p.x() / across, uy = on_axis ? 0 : p.y() / across / aspect;
    j(0, 0) = ux * value.by_focal;
    j(1, 0) = uy * value.by_focal;
    j(0, 1) = 1;
    j(1, 2) = 1;
    if (has_aspect_) j(1, 3) = -p.y() * scale / (aspect * aspect);
    for (int n = 0; n < own; ++n) {
      j(0, first_own + n) = ux * value.by_own[n];
      j(1, first_own + n) = uy * value.by_own[n];
    }
  }
  if (wants_pose) {
    // Derivatives by the point in the camera frame, then by rotation and translation.
    Eigen::Matrix<double, 2, 3> by_point = Eigen::Matrix<double, 2, 3>::Zero();
    if (on_axis) {
      by_point(0, 0) = by_point(1, 1) = scale;
    } else {
      const double length2 = across2 + p.z() * p.z();
      const Eigen::RowVector3d theta_by(p.z() * p.x() / (across * length2),
                                        p.z() * p.y() / (across * length2), -across / length2);
      const double r3 = value.r / (across2 * across);
      by_point.row(0) = value.by_theta * p.x() / across * theta_by;
      by_point.row(1) = value.by_theta * p.y() / across * theta_by;
      by_point(0, 0) += r3 * p.y() * p.y();
      by_point(0, 1) -= r3 * p.x() * p.y();
      by_point(1, 0) -= r3 * p.x() * p.y();
      by_point(1, 1) += r3 * p.x() * p.x();
    }
    by_point.row(1) /= aspect;
    Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>> j(jacobians[1]);
    j.leftCols<3>() = -by_point * turn * Cross(x) * right;
    j.rightCols<3>() = by_point;
  }
  return true;
}

}  // namespace arthro::authoring
