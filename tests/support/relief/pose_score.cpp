#include "tests/support/relief/pose_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

namespace arthro::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d AxesOf(const authoring::PosedFrame& frame) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(frame.rotation.data());
}

bool HasTruth(const authoring::PosedFrame& frame, const std::vector<authoring::CameraPose>& truth) {
  return frame.is_posed && static_cast<std::size_t>(frame.index) < truth.size();
}

}  // namespace

std::optional<CameraFit> FitCameras(std::span<const authoring::PosedFrame> frames,
                                    const std::vector<authoring::CameraPose>& truth) {
  constexpr double kAxis = 4e-3;  // m
  CameraFit fit;
  // The length of the axes depends on the scale: first by the centres alone, then again.
  for (int round = 0; round < 13; ++round) {
    std::vector<Vector3d> from, to;
    for (const authoring::PosedFrame& frame : frames) {
      if (!HasTruth(frame, truth)) continue;
      const authoring::CameraPose& pose = truth[static_cast<std::size_t>(frame.index)];
      const Eigen::Map<const Vector3d> centre(frame.centre.data());
      const Matrix3d axes = AxesOf(frame);
      from.push_back(centre);
      to.push_back(pose.centre);
      for (int axis = 0; axis < 3 && round > 0; ++axis) {
        from.push_back(centre + kAxis / fit.scale * axes.col(axis));
        to.push_back(pose.centre + kAxis * pose.world_from_camera.col(axis));
      }
    }
    if (from.size() < 2) return std::nullopt;
    const auto columns = [](const std::vector<Vector3d>& points) {
      return Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3,
                                                static_cast<Eigen::Index>(points.size()));
    };
    if (round == 0) {
      const Eigen::Matrix3Xd a = columns(from).colwise() - columns(from).rowwise().mean(),
                             b = columns(to).colwise() - columns(to).rowwise().mean();
      if (!(a.norm() > 1e-9) || !(b.norm() > 1e-9)) return std::nullopt;  // nothing moved
      fit.scale = b.norm() / a.norm();
      continue;
    }
    const Eigen::Matrix4d matrix = Eigen::umeyama(columns(from), columns(to), true);
    fit.scale = matrix.col(0).head<3>().norm();
    fit.rotation = matrix.topLeftCorner<3, 3>() / fit.scale;
    fit.shift = matrix.topRightCorner<3, 1>();
  }
  return fit;
}

PoseScore ScorePoses(const authoring::ReliefReport& report, const CavityTruth& truth) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  PoseScore score{0, kUnknown, kUnknown, kUnknown};
  const auto fit = FitCameras(report.frames, truth.poses);
  double squares = 0, turns = 0;
  for (const authoring::PosedFrame& frame : report.frames) {
    if (!HasTruth(frame, truth.poses)) continue;
    ++score.posed;
    if (!fit) continue;
    const authoring::CameraPose& pose = truth.poses[static_cast<std::size_t>(frame.index)];
    const Eigen::Map<const Vector3d> centre(frame.centre.data());
    squares += (fit->True(centre) - pose.centre).squaredNorm();
    const double cosine =
        ((fit->rotation * AxesOf(frame)).cwiseProduct(pose.world_from_camera).sum() - 1) / 2;
    turns += std::acos(std::clamp(cosine, -1.0, 1.0));
  }
  if (!fit || score.posed == 0) return score;
  score.path = std::sqrt(squares / score.posed);
  score.rotation = turns / score.posed;
  score.portal = (fit->shift - truth.portal).norm();
  return score;
}

}  // namespace arthro::test
