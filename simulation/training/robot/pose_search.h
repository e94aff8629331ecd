// Search for poses of the scope that see targets: rolls of 30°, insertions of 3 mm, and the
// direction of the rod by Newton's method so that a target lies in the middle of the picture.
// Portal frame, m, rad.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/core/units.h"
#include "simulation/haptics/relief/depth_field.h"
#include "simulation/haptics/surface/surface_bvh.h"
#include "simulation/practice/scope_eye.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scope/rod_pose.h"
#include "simulation/scope/window_lens.h"
#include "simulation/training/observe/observer.h"
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

// A pose with a target in the middle of the picture, and what it sees.
struct ScopeLook {
  RodPose pose;
  PointSight sight;
};

// Looks of one scope at several targets.
class PoseSearch {
 public:
  // At most kMostTargets. `relief` and `eye` are those of the practice and outlive this. `trial`:
  // another eye, which is led to each pose: one beside its tip is no pose to see from; null: no
  // such test.
  PoseSearch(const LoadedScene& loaded, const std::vector<TargetPlace>& targets, double view_angle,
             const DepthField& relief, const ScopeEye& eye, double shaft_radius = 2e-3,
             ScopeEye* trial = nullptr);

  int count() const { return count_; }
  // Present place of a target.
  glm::dvec3 Place(int target) const;

  // Turns the rod of `pose`, with its roll and insertion, until `x` is in the middle of the
  // picture. Returns nullopt where it does not get there.
  std::optional<RodPose> Centred(RodPose pose, const glm::dvec3& x) const;
  // The pose with this roll and insertion that has the target in the middle and sees it clearly,
  // with its shaft off relief and tissues.
  std::optional<ScopeLook> At(int target, double roll, double insertion) const;
  // Sight of all targets from a pose, without the instrument.
  Observation See(const RodPose& pose) const;
  // True where the shaft of this pose is off relief and tissues, and the eye at its tip.
  bool IsFree(const RodPose& pose) const;

  // Tries all rolls and insertions for a target in the middle, and returns the pose of the least
  // cost. A cost of nullopt rejects a look.
  using Cost = std::function<std::optional<double>(const ScopeLook&)>;
  std::optional<RodPose> Best(int target, const Cost& cost) const;
  static std::vector<double> Rolls();
  static std::vector<double> Insertions();

 private:
  ScopeOptics optics_;
  double view_angle_, shaft_radius_;
  int count_;
  const DepthField& relief_;
  Observer observer_;
  std::vector<SurfaceBvh> tissues_;
  Observation rest_;
  ScopeEye* trial_;
};

}  // namespace arthro::simulation
