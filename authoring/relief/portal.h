// The portal in a reconstruction, found from the shafts that all pass it, and the portal frame
// [method.md, Frames]: origin at the portal, +z the mean direction of the shaft, +x to the right of
// the pictures, +y down.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/bundle.h"

namespace arthro::authoring {

// The point nearest to all shafts, by linear least squares.
struct PivotFit {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double head_turn = 0;         // rad
  double shaft_spread = 0;      // rad, standard deviation of the shafts' directions
  double median_insertion = 0;  // from the point to a tip; negative where it lies in front
  double median_miss = 0;       // between the point and a shaft
};

PivotFit FitPivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                  double head_turn);

// The same with the turn of the camera head that makes the shafts meet best; 0 unless another one
// is clearly better.
PivotFit FindPivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle);

// Rotation portal_from_world about the portal.
Eigen::Matrix3d PortalAxes(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                           double head_turn);

// x ↦ scale · axes (x - origin), for poses and points.
void ChangeFrame(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, double scale,
                 Reconstruction& scene);

}  // namespace arthro::authoring
