#include "app/steps/panorama/board/motion_plan.h"

#include <algorithm>
#include <cmath>

#include <glm/vec3.hpp>

namespace arthro::app {
namespace {

// Middle and half width of what is shown: almost all points and all cameras.
struct Frame {
  glm::dvec3 middle{0.0};
  double half = 1;
};

Frame FrameOf(const authoring::ReliefSoFar& so_far) {
  Frame frame;
  frame.half = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const glm::dvec3& point : so_far.points) values.push_back(point[axis]);
    std::sort(values.begin(), values.end());
    // Single points that lie far away do not make all others small.
    const std::size_t cut = values.size() / 50;
    double low = values.empty() ? 0 : values[cut];
    double high = values.empty() ? 0 : values[values.size() - 1 - cut];
    for (const auto& camera : so_far.cameras) {
      low = std::min(low, camera.centre[axis]);
      high = std::max(high, camera.centre[axis]);
    }
    if (so_far.is_in_portal_frame) low = std::min(low, 0.0), high = std::max(high, 0.0);
    frame.middle[axis] = 0.5 * (low + high);
    frame.half = std::max(frame.half, 0.5 * (high - low));
  }
  if (!(frame.half > 0) || !std::isfinite(frame.half)) frame.half = 1;
  return frame;
}

}  // namespace

MotionPlan PlanOf(const authoring::ReliefSoFar& so_far, PlanSide side) {
  const Frame frame = FrameOf(so_far);
  // From above: right is right and ahead is up. From the side: ahead is right and down is down.
  const auto flat = [side](const glm::dvec3& v) {
    return side == PlanSide::kAbove ? glm::dvec2(v.x, -v.z) : glm::dvec2(v.z, v.y);
  };
  const auto place = [&](const glm::dvec3& point) {
    constexpr double kFilled = 0.92;  // share of the square
    return kFilled / frame.half * flat(point - frame.middle);
  };
  MotionPlan plan;
  for (const glm::dvec3& point : so_far.points) {
    const glm::dvec2 at = place(point);
    if (std::abs(at.x) <= 1 && std::abs(at.y) <= 1) plan.points.push_back(at);
  }
  for (const auto& camera : so_far.cameras)
    plan.cameras.push_back({place(camera.centre), flat(camera.view)});
  if (so_far.is_in_portal_frame) plan.portal = place(glm::dvec3(0.0));
  return plan;
}

}  // namespace arthro::app
