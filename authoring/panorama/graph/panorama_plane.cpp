#include "authoring/panorama/graph/panorama_plane.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {
namespace {

// Image of a point under a homography, and the local Jacobian.
struct Local {
  cv::Point2d at;
  cv::Matx22d jacobian;
  bool is_valid = false;
};

Local LocalOf(const cv::Matx33d& m, const cv::Point2d& p) {
  const cv::Vec3d q = m * cv::Vec3d(p.x, p.y, 1);
  Local local;
  if (!(q[2] > 1e-9)) return local;
  local.at = {q[0] / q[2], q[1] / q[2]};
  local.jacobian = {
      (m(0, 0) - local.at.x * m(2, 0)) / q[2], (m(0, 1) - local.at.x * m(2, 1)) / q[2],
      (m(1, 0) - local.at.y * m(2, 0)) / q[2], (m(1, 1) - local.at.y * m(2, 1)) / q[2]};
  local.is_valid = cv::determinant(local.jacobian) > 1e-9;
  return local;
}

// Removes shear: S with S C S^T = I for a symmetric positive C, times the root of its size.
cv::Matx22d RoundingOf(const cv::Matx22d& c) {
  const double root = std::sqrt(cv::determinant(c));
  const double trace = std::sqrt(c(0, 0) + c(1, 1) + 2 * root);
  const cv::Matx22d square_root = (c + root * cv::Matx22d::eye()) * (1 / trace);
  return square_root.inv() * std::sqrt(root);
}

}  // namespace

cv::Matx33d LeastStretchedPlane(const std::vector<cv::Matx33d>& reference_from_frame,
                                const FrameWindow& window) {
  cv::Matx33d plane = cv::Matx33d::eye();
  if (reference_from_frame.empty()) return plane;
  for (int step = 0; step < 8; ++step) {
    // Logarithm of the area's scale s = mean + g . (q - centre): a slope is perspective, and w = 1
    // + v . (q - centre) scales areas by w^-3.
    std::vector<Local> locals;
    cv::Point2d centre{0, 0};
    double mean = 0;
    cv::Matx22d shear = cv::Matx22d::zeros();
    for (const cv::Matx33d& place : reference_from_frame)
      for (const cv::Point2d& p : window.nine) {
        const Local local = LocalOf(plane * place, p);
        if (!local.is_valid) return step == 0 ? cv::Matx33d::eye() : plane;
        const double area = cv::determinant(local.jacobian);
        centre += local.at;
        mean += std::log(area);
        shear += local.jacobian * local.jacobian.t() * (1 / area);
        locals.push_back(local);
      }
    const double count = static_cast<double>(locals.size());
    centre *= 1 / count;
    mean /= count;
    cv::Matx22d spread = cv::Matx22d::zeros();
    cv::Vec2d slope(0, 0);
    for (const Local& local : locals) {
      const cv::Vec2d off(local.at.x - centre.x, local.at.y - centre.y);
      spread += off * off.t();
      slope += off * (std::log(cv::determinant(local.jacobian)) - mean);
    }
    if (!(cv::determinant(spread) > 0)) break;
    cv::Vec2d v = spread.inv() * slope * (1.0 / 3);
    // No point may come near the horizon in one step.
    double most = 0;
    for (const Local& local : locals)
      most =
          std::max(most, std::abs(v[0] * (local.at.x - centre.x) + v[1] * (local.at.y - centre.y)));
    if (most > 0.3) v *= 0.3 / most;
    const cv::Matx22d rounding = RoundingOf(shear * (1 / count)) * std::exp(-0.5 * mean);
    const cv::Matx33d to(1, 0, -centre.x, 0, 1, -centre.y, 0, 0, 1),
        from(1, 0, centre.x, 0, 1, centre.y, 0, 0, 1), tilt(1, 0, 0, 0, 1, 0, v[0], v[1], 1),
        round(rounding(0, 0), rounding(0, 1), 0, rounding(1, 0), rounding(1, 1), 0, 0, 0, 1);
    plane = from * round * tilt * to * plane;
    plane = plane * (1 / cv::norm(plane) * std::sqrt(3.0));
    if (most < 1e-6) break;
  }
  return plane;
}

cv::Matx33d NaturalScale(const std::vector<cv::Matx33d>& reference_from_frame,
                         const FrameWindow& window) {
  double mean = 0;
  int count = 0;
  for (const cv::Matx33d& place : reference_from_frame) {
    const Local local = LocalOf(place, window.centre);
    if (!local.is_valid) continue;
    mean += std::log(cv::determinant(local.jacobian));
    ++count;
  }
  const double scale = count > 0 ? std::exp(-0.5 * mean / count) : 1.0;
  return {scale, 0, 0, 0, scale, 0, 0, 0, 1};
}

}  // namespace arthro::authoring
