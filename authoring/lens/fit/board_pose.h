// Pose of a flat target relative to the camera, from rays alone. camera_from_board takes lattice
// coordinates (steps, in the plane z = 0) to the camera frame, in steps. The rotation is a vector:
// axis times angle, rad.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <opencv2/core.hpp>

namespace arthro::authoring {

using BoardPose = std::array<double, 6>;  // rotation vector, then translation

struct BoardRay {
  cv::Point2d on_board;  // (i, j), steps
  cv::Vec3d ray;         // unit, camera frame
};

// Direct linear transformation over rays, which may lie beyond 90 degrees from the axis, then the
// nearest rigid pose. Returns nothing when the points are collinear or fewer than four.
std::optional<BoardPose> PoseFromRays(std::span<const BoardRay> rays);

}  // namespace arthro::authoring
