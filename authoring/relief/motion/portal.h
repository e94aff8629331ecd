// The portal in a reconstruction, found from the shafts that all pass it, and the portal frame
// [method.md, Frames]: origin at the portal, +z the mean direction of the shaft, +x to the right of
// the pictures, +y down.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/motion/bundle/bundle.h"

namespace arthro::authoring {

// How the camera head sits on the shaft over a clip.
enum class HeadMotion {
  kLocked,    // at one turn, which may be 0
  kWandering  // its turn changes from frame to frame, as when it is held upright
};

// A portal, from a frame on until the next one begins.
struct PortalStretch {
  int first = 0;  // frame
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

// The points nearest to all shafts.
struct PivotFit {
  std::vector<PortalStretch> stretches{PortalStretch{}};  // more than one where the portal slid
  HeadMotion head = HeadMotion::kLocked;
  std::vector<double> head_turns;  // rad, one per frame
  double shaft_spread = 0;         // rad, standard deviation of the shafts' directions
  double median_insertion = 0;     // from the point to a tip; negative where it lies in front
  double median_miss = 0;          // between the point and a shaft

  const Eigen::Vector3d& PointOf(int frame) const;
  double MedianHeadTurn(const std::vector<std::optional<CameraPose>>& poses) const;
};

// One portal, with a known turn of the camera head per frame, by linear least squares.
PivotFit FitPivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                  const std::vector<double>& head_turns);

// Median insertion and miss of a fit whose portals and turns are known.
void MeasurePivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                  PivotFit& fit);

// The simplest of four explanations that lets the shafts meet: a straight head; a head at one turn;
// a portal that slid once; a head that wanders. A later one must be clearly better than those
// before. `is_straight`: the head is known to be straight.
PivotFit FindPivot(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                   bool is_straight = false);

// Rotation portal_from_world about the portal.
Eigen::Matrix3d PortalAxes(const std::vector<std::optional<CameraPose>>& poses, double view_angle,
                           const std::vector<double>& head_turns);

// x ↦ scale · axes (x - origin), for poses and points.
void ChangeFrame(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, double scale,
                 Reconstruction& scene);

}  // namespace arthro::authoring
