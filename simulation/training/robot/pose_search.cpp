#include "simulation/training/robot/pose_search.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/haptics/proxy.h"
#include "simulation/scope/window_lens.h"
#include "simulation/training/observe/observer.h"

namespace arthro::simulation {
namespace {

constexpr double kRollStep = 30.0 * kRadianPerDegree;
constexpr int kRolls = 12;
constexpr double kFirstInsertion = 2e-3, kInsertionStep = 3e-3;  // m
constexpr int kInsertions = 9;
constexpr double kSteepest = 1.3;  // rad, of latitude and longitude

// Place of a point in the picture of a scope at `pose`, in radii of the picture.
glm::dvec2 PlaceAt(const ScopeOptics& optics, const RodPose& pose, double view_angle,
                   const glm::dvec3& x) {
  const ScopeView view = ViewFromPose(pose, view_angle);
  return PlaceOf(optics, view, glm::normalize(x - view.tip));
}

// Turns the rod until `x` is in the middle of the picture. Returns false where it does not get
// there.
bool Centre(const ScopeOptics& optics, double view_angle, const glm::dvec3& x, RodPose& pose) {
  constexpr int kMostSteps = 12;
  constexpr double kStep = 1e-6, kCentred = 1e-6, kLongest = 0.3;
  for (int i = 0; i < kMostSteps; ++i) {
    const glm::dvec2 off = PlaceAt(optics, pose, view_angle, x);
    if (glm::length(off) < kCentred) return true;
    RodPose north = pose, east = pose;
    north.latitude += kStep;
    east.longitude += kStep;
    const glm::dvec2 by_north = (PlaceAt(optics, north, view_angle, x) - off) / kStep;
    const glm::dvec2 by_east = (PlaceAt(optics, east, view_angle, x) - off) / kStep;
    const double det = by_north.x * by_east.y - by_north.y * by_east.x;
    if (!(std::abs(det) > 1e-9)) return false;
    glm::dvec2 change((by_east.x * off.y - by_east.y * off.x) / det,
                      (by_north.y * off.x - by_north.x * off.y) / det);
    if (glm::length(change) > kLongest) change *= kLongest / glm::length(change);
    pose.latitude += change.x;
    pose.longitude += change.y;
    if (!(std::abs(pose.latitude) < kSteepest && std::abs(pose.longitude) < kSteepest))
      return false;
  }
  return false;
}

AttemptFrame FrameAt(const RodPose& pose, double view_angle) {
  AttemptFrame frame;
  ToolFrame& scope = frame.tool[0];
  scope.tip = scope.drawn_tip = glm::vec3(TipInOwnPortal(pose));
  scope.axis = glm::vec3(BasisOf(pose).axis);
  scope.roll = frame.head_roll = static_cast<float>(pose.roll);
  scope.depth = static_cast<float>(pose.depth);
  scope.is_valid = true;
  frame.view_angle = static_cast<float>(view_angle);
  return frame;
}

}  // namespace

std::optional<RodPose> PoseThatSees(const LoadedScene& loaded, const TargetPlace& target,
                                    double view_angle, const DepthField& relief,
                                    const ScopeEye& eye, const PoseSearchOptions& options) {
  const ScopeOptics optics = OpticsOf(loaded.scene.scope, loaded.lens);
  const Observer observer(loaded, {target}, relief, eye);
  AttemptFrame frame;
  observer.Observe(frame);
  const glm::dvec3 x(frame.sight.target[0].place);
  std::vector<SurfaceBvh> tissues;
  for (std::size_t i = 0; i < loaded.scene.tissues.size() && i < loaded.surfaces.size(); ++i)
    tissues.emplace_back(OrEmpty(loaded.surfaces[i]), loaded.scene.tissues[i].pose);
  const Surroundings around{relief, tissues};

  std::optional<RodPose> best;
  double least = options.most_incidence;
  for (int roll = 0; roll < kRolls; ++roll)
    for (int step = 0; step < kInsertions; ++step) {
      RodPose pose;
      pose.latitude = std::asin(-x.y / glm::length(x));
      pose.longitude = std::atan2(x.x, x.z);
      pose.roll = roll * kRollStep;
      pose.depth = kFirstInsertion + step * kInsertionStep;
      if (!Centre(optics, view_angle, x, pose)) continue;
      frame = FrameAt(pose, view_angle);
      observer.Observe(frame);
      const PointSight& sight = frame.sight.target[0];
      if (!sight.is_clear || sight.distance < options.nearest ||
          sight.distance > options.farthest || sight.incidence > least)
        continue;
      if (!IsWayFree(around, options.shaft_radius, glm::dvec3(0.0), TipInOwnPortal(pose))) continue;
      least = sight.incidence;
      best = pose;
    }
  return best;
}

}  // namespace arthro::simulation
