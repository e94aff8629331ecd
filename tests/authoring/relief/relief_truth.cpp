#include "tests/authoring/relief/relief_truth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace arthro::test {
namespace {

// Similarity that fits the cameras best, by their centres and by points 4 mm along their axes: the
// centres alone say little about the rotation.
Eigen::Matrix4d TrueFromFound(const authoring::ReliefReport& report,
                              const std::vector<authoring::CameraPose>& truth) {
  constexpr double kAxis = 4e-3;  // m
  double scale = 1;
  Eigen::Matrix4d fit = Eigen::Matrix4d::Identity();
  for (int round = 0; round < 5; ++round) {
    std::vector<Eigen::Vector3d> from, to;
    for (const authoring::PosedFrame& frame : report.frames) {
      if (!frame.is_posed) continue;
      const authoring::CameraPose& pose = truth[static_cast<std::size_t>(frame.index)];
      const Eigen::Map<const Eigen::Vector3d> centre(frame.centre.data());
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(
          frame.rotation.data());
      from.push_back(centre);
      to.push_back(pose.centre);
      for (int axis = 0; axis < 3; ++axis) {
        from.push_back(centre + kAxis / scale * axes.col(axis));
        to.push_back(pose.centre + kAxis * pose.world_from_camera.col(axis));
      }
    }
    const auto columns = [](const std::vector<Eigen::Vector3d>& points) {
      return Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3,
                                                static_cast<Eigen::Index>(points.size()));
    };
    fit = Eigen::umeyama(columns(from), columns(to), true);
    scale = fit.col(0).head<3>().norm();
  }
  return fit;
}

}  // namespace

double MedianRadialError(const authoring::ReliefResult& result, const CavityOptions& clip) {
  const Eigen::Matrix4d true_from_found = TrueFromFound(result.report, CavityPoses(clip));
  std::vector<double> errors;
  for (int y = 0; y < result.relief.height; ++y)
    for (int x = 0; x < result.relief.width; ++x) {
      if (result.origin.at(x, y) != ReliefOrigin::kMeasured) continue;
      const float h = result.relief.at(x, y);
      const glm::dvec3 d = DirectionFromPixel(result.report.projection, {x, y});
      const Eigen::Vector3d found = Eigen::Vector3d(d.x, d.y, d.z) * (result.report.radius - h);
      const Eigen::Vector3d point =
          true_from_found.topLeftCorner<3, 3>() * found + true_from_found.topRightCorner<3, 1>();
      errors.push_back(std::abs(point.norm() - CavityRadius(point.normalized(), clip.fold)));
    }
  if (errors.empty()) return 1;
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors[errors.size() / 2];
}

}  // namespace arthro::test
