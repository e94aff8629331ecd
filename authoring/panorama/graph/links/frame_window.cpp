#include "authoring/panorama/graph/links/frame_window.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {

FrameWindow WindowOf(const RectifiedView& view, const cv::Mat& mask) {
  FrameWindow window;
  window.centre = {view.cx, view.cy};
  window.radius = 0.5 * std::min(view.width, view.height);
  if (!mask.empty()) {
    // Radius of the circle with the mask's area; dents or a flattened top have little effect on it.
    const double scale = static_cast<double>(view.width) / mask.cols;
    const double radius = std::sqrt(cv::countNonZero(mask) / CV_PI) * scale;
    if (radius > 0) window.radius = radius;
  }

  // 85 % of the raw radius, by the equisolid r = 2 f sin(theta / 2); a share of the radius without
  // a focal length.
  double reach = 0.85 * window.radius;
  if (view.focal_px > 0) {
    const double rim = std::atan(window.radius / view.focal_px);
    reach = view.focal_px * std::tan(2 * std::asin(0.85 * std::sin(rim / 2)));
  }
  window.nine.push_back(window.centre);
  for (int i = 0; i < 8; ++i)
    window.nine.emplace_back(window.centre.x + reach * std::cos(i * CV_PI / 4),
                             window.centre.y + reach * std::sin(i * CV_PI / 4));
  constexpr int kAcross = 11;
  for (int y = 0; y < kAcross; ++y)
    for (int x = 0; x < kAcross; ++x) {
      const double u = 2.0 * x / (kAcross - 1) - 1, v = 2.0 * y / (kAcross - 1) - 1;
      if (u * u + v * v <= 1)
        window.grid.emplace_back(window.centre.x + u * window.radius,
                                 window.centre.y + v * window.radius);
    }
  return window;
}

double OverlapOf(const FrameWindow& window, const cv::Matx33d& b_from_a) {
  const cv::Vec3d centre = b_from_a * cv::Vec3d(window.centre.x, window.centre.y, 1);
  // Scaling makes the third coordinate positive at the centre; a negative determinant is a
  // reflection.
  if (!(cv::determinant(b_from_a) * centre[2] > 0)) return 0;
  int inside = 0;
  for (const cv::Point2d& p : window.grid) {
    const cv::Vec3d q = b_from_a * cv::Vec3d(p.x, p.y, 1);
    if (!(q[2] * centre[2] > 0)) continue;
    const double x = q[0] / q[2] - window.centre.x, y = q[1] / q[2] - window.centre.y;
    if (x * x + y * y <= window.radius * window.radius) ++inside;
  }
  return static_cast<double>(inside) / static_cast<double>(window.grid.size());
}

}  // namespace arthro::authoring
