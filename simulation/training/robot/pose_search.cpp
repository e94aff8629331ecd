#include "simulation/training/robot/pose_search.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/haptics/proxy.h"

namespace arthro::simulation {
namespace {

constexpr double kRollStep = 30.0 * kRadianPerDegree;
constexpr int kRolls = 12;
constexpr double kFirstInsertion = 2e-3, kInsertionStep = 3e-3;  // m
constexpr int kInsertions = 9;
constexpr double kOffTip = 1e-4;   // m, of an eye from its tip
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

PoseSearch::PoseSearch(const LoadedScene& loaded, const std::vector<TargetPlace>& targets,
                       double view_angle, const DepthField& relief, const ScopeEye& eye,
                       double shaft_radius, ScopeEye* trial)
    : optics_(OpticsOf(loaded.scene.scope, loaded.lens)),
      view_angle_(view_angle),
      shaft_radius_(shaft_radius),
      count_(static_cast<int>(targets.size())),
      relief_(relief),
      observer_(loaded, targets, relief, eye),
      trial_(trial) {
  for (std::size_t i = 0; i < loaded.scene.tissues.size() && i < loaded.surfaces.size(); ++i)
    tissues_.emplace_back(OrEmpty(loaded.surfaces[i]), loaded.scene.tissues[i].pose);
  AttemptFrame frame;
  observer_.Observe(frame);
  rest_ = frame.sight;
}

glm::dvec3 PoseSearch::Place(int target) const {
  return glm::dvec3(rest_.target[static_cast<std::size_t>(target)].place);
}

std::optional<RodPose> PoseSearch::Centred(RodPose pose, const glm::dvec3& x) const {
  return Centre(optics_, view_angle_, x, pose) ? std::optional(pose) : std::nullopt;
}

Observation PoseSearch::See(const RodPose& pose) const {
  AttemptFrame frame = FrameAt(pose, view_angle_);
  observer_.Observe(frame);
  return frame.sight;
}

bool PoseSearch::IsFree(const RodPose& pose) const {
  const glm::dvec3 tip = TipInOwnPortal(pose);
  if (!IsWayFree({relief_, tissues_}, shaft_radius_, glm::dvec3(0.0), tip)) return false;
  if (trial_ == nullptr) return true;
  trial_->Leave();
  trial_->MoveTo(pose, tip);
  return glm::length(trial_->beside()) < kOffTip;
}

std::optional<ScopeLook> PoseSearch::At(int target, double roll, double insertion) const {
  const glm::dvec3 x = Place(target);
  RodPose pose;
  pose.latitude = std::asin(-x.y / glm::length(x));
  pose.longitude = std::atan2(x.x, x.z);
  pose.roll = roll;
  pose.depth = insertion;
  if (!Centre(optics_, view_angle_, x, pose)) return std::nullopt;
  const PointSight sight = See(pose).target[static_cast<std::size_t>(target)];
  if (!sight.is_clear || !IsFree(pose)) return std::nullopt;
  return ScopeLook{pose, sight};
}

std::vector<double> PoseSearch::Rolls() {
  std::vector<double> rolls;
  rolls.reserve(kRolls);
  for (int i = 0; i < kRolls; ++i) rolls.push_back(i * kRollStep);
  return rolls;
}

std::vector<double> PoseSearch::Insertions() {
  std::vector<double> insertions;
  insertions.reserve(kInsertions);
  for (int i = 0; i < kInsertions; ++i) insertions.push_back(kFirstInsertion + i * kInsertionStep);
  return insertions;
}

std::optional<RodPose> PoseSearch::Best(int target, const Cost& cost) const {
  std::optional<RodPose> best;
  double least = 0;
  for (const double roll : Rolls())
    for (const double insertion : Insertions()) {
      const auto look = At(target, roll, insertion);
      const auto value = look ? cost(*look) : std::nullopt;
      if (!value || (best && *value >= least)) continue;
      least = *value;
      best = look->pose;
    }
  return best;
}

std::optional<RodPose> PoseThatSees(const LoadedScene& loaded, const TargetPlace& target,
                                    double view_angle, const DepthField& relief,
                                    const ScopeEye& eye, const PoseSearchOptions& options) {
  const PoseSearch search(loaded, {target}, view_angle, relief, eye, options.shaft_radius);
  return search.Best(0, [&](const ScopeLook& look) -> std::optional<double> {
    const PointSight& sight = look.sight;
    if (sight.distance < options.nearest || sight.distance > options.farthest ||
        sight.incidence > options.most_incidence)
      return std::nullopt;
    return sight.incidence;
  });
}

}  // namespace arthro::simulation
