// The equisolid lens r = 2 f sin(θ/2), implemented a second time: the renderer of the truth must
// not use the code that a test checks against it (scene/lens.h).
#pragma once

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

inline cv::Vec3d EquisolidRay(const Lens& lens, double x, double y) {
  const double dx = x - lens.cx, dy = y - lens.cy, r = std::hypot(dx, dy);
  const double theta = 2 * std::asin(std::min(r / (2 * lens.focal_px), 1.0));
  const double k = r > 1e-9 ? std::sin(theta) / r : 1 / lens.focal_px;
  return {dx * k, dy * k, std::cos(theta)};
}

inline cv::Point2d EquisolidPixel(const Lens& lens, const cv::Vec3d& ray) {
  const double across = std::hypot(ray[0], ray[1]);
  const double r = 2 * lens.focal_px * std::sin(std::atan2(across, ray[2]) / 2);
  const double k = across > 0 ? r / across : 0.0;
  return {lens.cx + k * ray[0], lens.cy + k * ray[1]};
}

}  // namespace arthro::authoring
