#include "authoring/relief/portal.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "authoring/relief/median.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
PivotFit FitPivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                  double head_turn) {
  PivotFit fit;
  fit.head_turn = head_turn;
  const Eigen::Vector3d shaft = ShaftInCamera(view_angle, head_turn);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int count = 0;
  for (const auto& pose : poses) {
    if (!pose) continue;
    const Eigen::Vector3d u = pose->world_from_camera * shaft;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - u * u.transpose();
    normal += across;
    right += across * pose->centre;
    ++count;
  }
  if (count < 3) return fit;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal / count);
  fit.shaft_spread = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
  fit.point = normal.ldlt().solve(right);
  std::vector<double> insertions, misses;
  for (const auto& pose : poses) {
    if (!pose) continue;
    const Eigen::Vector3d u = pose->world_from_camera * shaft, way = pose->centre - fit.point;
    insertions.push_back(u.dot(way));
    misses.push_back((way - u * u.dot(way)).norm());
  }
  fit.median_insertion = Median(insertions);
  fit.median_miss = Median(misses);
  return fit;
}

PivotFit FindPivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle) {
  const auto cost = [](const PivotFit& fit) {
    return fit.median_insertion > 0 ? fit.median_miss / fit.median_insertion : 1e9;
  };
  const PivotFit straight = FitPivot(poses, view_angle, 0);
  PivotFit best = straight;
  for (int degrees = -175; degrees <= 180; degrees += 5) {
    const PivotFit fit = FitPivot(poses, view_angle, RadiansFromDegrees(degrees));
    if (cost(fit) < cost(best)) best = fit;
  }
  constexpr double kClearly = 0.4;  // share of the straight head's miss
  if (cost(best) > kClearly * cost(straight)) return straight;
  const double coarse = best.head_turn;
  for (double degrees = -5; degrees <= 5; degrees += 0.25) {
    const PivotFit fit = FitPivot(poses, view_angle, coarse + RadiansFromDegrees(degrees));
    if (cost(fit) < cost(best)) best = fit;
  }
  return best;
}

Eigen::Matrix3d PortalAxes(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                           double head_turn) {
  const Eigen::Vector3d shaft = ShaftInCamera(view_angle, head_turn);
  Eigen::Vector3d z = Eigen::Vector3d::Zero(), x = Eigen::Vector3d::Zero();
  for (const auto& pose : poses)
    if (pose) {
      z += pose->world_from_camera * shaft;
      x += pose->world_from_camera.col(0);
    }
  z.normalize();
  x -= z * z.dot(x);
  if (x.norm() < 1e-6) x = z.unitOrthogonal();
  x.normalize();
  Eigen::Matrix3d axes;
  axes.row(0) = x;
  axes.row(1) = z.cross(x);
  axes.row(2) = z;
  return axes;
}

void ChangeFrame(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, double scale,
                 Reconstruction& scene) {
  for (auto& pose : scene.poses)
    if (pose) {
      pose->world_from_camera = axes * pose->world_from_camera;
      pose->centre = scale * (axes * (pose->centre - origin));
    }
  for (TrackPoint& point : scene.points)
    point.position = scale * (axes * (point.position - origin));
}

}  // namespace arthro::authoring
