// Distance of found camera poses from the true ones of a cavity clip, after the similarity that
// fits them best: motion knows no scale, and the portal frame is found from the poses. m, rad.
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "authoring/relief/relief_report.h"
#include "tests/support/relief/cavity_truth.h"

namespace arthro::test {

// x_true = scale · rotation · x_found + shift
struct CameraFit {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  Eigen::Vector3d True(const Eigen::Vector3d& found) const {
    return scale * (rotation * found) + shift;
  }
  Eigen::Vector3d Found(const Eigen::Vector3d& truth) const {
    return rotation.transpose() * (truth - shift) / scale;
  }
};

// Fits the centres and points 4 mm along the axes of each camera: the centres alone say little
// about the rotation. Nothing where fewer than two frames are posed, or none of them moved.
std::optional<CameraFit> FitCameras(std::span<const authoring::PosedFrame> frames,
                                    const std::vector<authoring::CameraPose>& truth);

struct PoseScore {
  int posed = 0;
  double path = 0;      // m, rms distance of the tips
  double rotation = 0;  // rad, mean
  double portal = 0;    // m, distance of the found portal from the mean true one
};
// NaN where the poses cannot be fitted.
PoseScore ScorePoses(const authoring::ReliefReport& report, const CavityTruth& truth);

}  // namespace arthro::test
