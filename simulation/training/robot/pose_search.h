// Search for a pose of the scope that sees a target: rolls of 30°, insertions of 3 mm, and the
// direction of the rod by Newton's method so that the target lies in the middle of the picture.
// Portal frame, m, rad.
#pragma once

#include <optional>

#include "simulation/core/options.h"
#include "simulation/core/units.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/practice/scope_eye.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scope/rod_pose.h"
#include "simulation/training/observe/target_place.h"

namespace arthro::simulation {

struct PoseSearchOptions {
  double nearest = 8e-3, farthest = 25e-3;
  double most_incidence = 60.0 * kRadianPerDegree;
  double shaft_radius = 2e-3;
  template <class V>
  void Visit(V&& v) {
    v("nearest", nearest, Range{1e-3, 0.1}, "m", "Least distance of the lens from the target.");
    v("farthest", farthest, Range{1e-3, 0.1}, "m", "Largest distance of the lens from the target.");
    v("most_incidence", most_incidence, Range{0, RadiansFromDegrees(90)}, "rad",
      "Largest angle between the line of sight and the surface's normal.");
    v("shaft_radius", shaft_radius, Range{0, 0.01}, "m",
      "Distance of the shaft's middle from relief and tissues.");
  }
};

// Returns the pose with the least incidence among those that see the target clearly, or nullopt:
// no pose sees it with this view angle. Tissues are as `eye` has them; `relief` and `eye` are those
// of a practice.
std::optional<RodPose> PoseThatSees(const LoadedScene& loaded, const TargetPlace& target,
                                    double view_angle, const DepthField& relief,
                                    const ScopeEye& eye, const PoseSearchOptions& options = {});

}  // namespace arthro::simulation
