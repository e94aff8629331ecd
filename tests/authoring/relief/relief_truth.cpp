#include "tests/authoring/relief/relief_truth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/relief/pose_score.h"

namespace arthro::test {
double MedianRadialError(const authoring::ReliefResult& result, const CavityOptions& clip) {
  const auto fit = FitCameras(result.report.frames, CavityPoses(clip));
  if (!fit) return 1;
  std::vector<double> errors;
  for (int y = 0; y < result.relief.height; ++y)
    for (int x = 0; x < result.relief.width; ++x) {
      if (result.origin.at(x, y) != ReliefOrigin::kMeasured) continue;
      const float h = result.relief.at(x, y);
      const glm::dvec3 d = DirectionFromPixel(result.report.projection, {x, y});
      const Eigen::Vector3d found = Eigen::Vector3d(d.x, d.y, d.z) * (result.report.radius - h);
      const Eigen::Vector3d point = fit->True(found);
      errors.push_back(std::abs(point.norm() - CavityRadius(point.normalized(), clip.fold)));
    }
  if (errors.empty()) return 1;
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors[errors.size() / 2];
}

}  // namespace arthro::test
