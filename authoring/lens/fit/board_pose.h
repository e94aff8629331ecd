// Where a flat target stands before the camera, from rays alone. camera_from_board takes lattice
// coordinates (steps, in the plane z = 0) to the camera frame, in steps; the rotation is a vector
// (axis times angle, rad).
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

// Direct linear transformation over rays, which may point beyond 90 degrees; then the nearest rigid
// pose. Nothing where the points lie on one line or fewer than four are given.
std::optional<BoardPose> PoseFromRays(std::span<const BoardRay> rays);

}  // namespace arthro::authoring
