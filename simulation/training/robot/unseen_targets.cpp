#include "simulation/training/robot/unseen_targets.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/practice/living_tissues.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/robot/pose_search.h"
#include "simulation/training/steps/exercise_index.h"

namespace arthro::simulation {
namespace {

// Points of the skin of regions, which are seen where one of them is.
constexpr int kSkinPoints = 12;

struct LookLimits {
  glm::dvec2 distance{0.0, std::numeric_limits<double>::infinity()};
  double incidence = std::numbers::pi;
};

struct LimitsOfStep {
  LookLimits operator()(const SeeStep& step) const { return {step.distance, step.incidence}; }
  LookLimits operator()(const HoldStep& step) const { return {step.distance}; }
  LookLimits operator()(const PeriscopeStep& step) const { return {step.distance}; }
  LookLimits operator()(const TelescopeStep& step) const { return {{step.near, step.far}}; }
  LookLimits operator()(const StepBase&) const { return {}; }
};

bool IsSeen(const PoseSearch& search, int target, const LookLimits& limits) {
  for (const double insertion : PoseSearch::Insertions())
    for (const double roll : PoseSearch::Rolls()) {
      const auto look = search.At(target, roll, insertion);
      if (look && look->sight.distance >= limits.distance.x &&
          look->sight.distance <= limits.distance.y && look->sight.incidence <= limits.incidence)
        return true;
    }
  return false;
}

std::vector<double> AnglesOf(const LoadedScene& loaded, const Exercise& exercise,
                             const ExerciseStep& step) {
  if (const auto* ring = std::get_if<PeriscopeStep>(&step)) return {ring->view_angle};
  if (!exercise.setup.view_angles.empty()) return exercise.setup.view_angles;
  return {loaded.scene.scope.view_angle};
}

// Points of the skin in regions, whose middles lie in the tissue.
std::vector<TargetPlace> SkinOf(const LoadedScene& loaded, const TargetPlace& place) {
  const auto tissue = static_cast<std::size_t>(place.region_tissue);
  const Pose& pose = loaded.scene.tissues[tissue].pose;
  const BodyPlaces body = PlacesOf(loaded.scene.tissues[tissue], OrEmpty(loaded.surfaces[tissue]));
  std::vector<glm::dvec3> inside;
  for (const glm::dvec3& x : body.surface.vertices)
    if (std::ranges::any_of(place.regions, [&](int region) {
          const Ball& ball = body.regions[static_cast<std::size_t>(region)].ball;
          return glm::distance(x, ball.centre) <= ball.radius;
        }))
      inside.push_back(pose.quaternion * x + pose.position);
  std::vector<TargetPlace> places;
  const std::size_t count = std::min<std::size_t>(inside.size(), kSkinPoints);
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(TargetInBall(inside[i * inside.size() / count], place.radius));
  return places;
}

// Searches of one exercise, one per view angle.
class ExerciseCheck {
 public:
  ExerciseCheck(const LoadedScene& loaded, const Exercise& exercise, const DepthField& relief,
                const ScopeEye& eye)
      : loaded_(loaded),
        places_(PlacesOfTargets(loaded, exercise, relief)),
        relief_(relief),
        eye_(eye) {
    // A body that lies still is a ball.
    for (TargetPlace& place : places_)
      if (place.is_loose) place = TargetInBall(place.point, place.radius);
  }

  bool Sees(int target, double view_angle, const LookLimits& limits) {
    const TargetPlace& place = places_[static_cast<std::size_t>(target)];
    if (!place.regions.empty()) {
      const PoseSearch search(loaded_, SkinOf(loaded_, place), view_angle, relief_, eye_);
      for (int i = 0; i < search.count(); ++i)
        if (IsSeen(search, i, limits)) return true;
      return false;
    }
    const auto found =
        searches_.try_emplace(view_angle, loaded_, places_, view_angle, relief_, eye_);
    return IsSeen(found.first->second, target, limits);
  }

 private:
  const LoadedScene& loaded_;
  std::vector<TargetPlace> places_;
  const DepthField& relief_;
  const ScopeEye& eye_;
  std::map<double, PoseSearch> searches_;
};

// Adds the unseen targets of one exercise, each once.
void LookAt(const LoadedScene& loaded, const Exercise& exercise, const DepthField& relief,
            const ScopeEye& eye, const Progress& progress, std::vector<UnseenTarget>& unseen) {
  ExerciseCheck check(loaded, exercise, relief, eye);
  for (std::size_t i = 0; i < exercise.steps.size(); ++i) {
    const ExerciseStep& step = exercise.steps[i];
    const std::vector<double> angles = AnglesOf(loaded, exercise, step);
    const LookLimits limits = std::visit(LimitsOfStep{}, step);
    for (const int target : TargetsOf(exercise, step)) {
      progress.Step("Looking for poses",
                    static_cast<double>(i) / static_cast<double>(exercise.steps.size()));
      const std::string& id = exercise.targets[static_cast<std::size_t>(target)].id;
      const bool is_named = std::ranges::any_of(unseen, [&](const UnseenTarget& each) {
        return each.exercise == exercise.id && each.target == id;
      });
      if (is_named || std::ranges::any_of(
                          angles, [&](double angle) { return check.Sees(target, angle, limits); }))
        continue;
      unseen.push_back({exercise.id, id, angles});
    }
  }
}

}  // namespace

std::vector<UnseenTarget> UnseenTargets(const LoadedScene& loaded) {
  std::vector<UnseenTarget> unseen;
  if (std::ranges::all_of(loaded.scene.exercises,
                          [](const Exercise& each) { return each.steps.empty(); }))
    return unseen;
  const DepthField relief = ReliefOf(loaded);
  const ScopeEye eye(loaded);
  for (const Exercise& exercise : loaded.scene.exercises)
    if (!exercise.steps.empty()) LookAt(loaded, exercise, relief, eye, {}, unseen);
  return unseen;
}

std::vector<UnseenTarget> UnseenTargets(const LoadedScene& loaded, const Exercise& exercise,
                                        const Progress& progress) {
  std::vector<UnseenTarget> unseen;
  const DepthField relief = ReliefOf(loaded);
  const ScopeEye eye(loaded);
  LookAt(loaded, exercise, relief, eye, progress, unseen);
  return unseen;
}

std::string AnglesOf(const UnseenTarget& unseen) {
  std::string angles;
  for (const double angle : unseen.view_angles)
    angles += fmt::format("{}{:g}°", angles.empty() ? "" : " or ", DegreesFromRadians(angle));
  return angles;
}

std::string ToString(const UnseenTarget& unseen) {
  return fmt::format("exercise \"{}\": no pose sees target \"{}\" with a {} scope", unseen.exercise,
                     unseen.target, AnglesOf(unseen));
}

}  // namespace arthro::simulation
