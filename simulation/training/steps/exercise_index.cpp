#include "simulation/training/steps/exercise_index.h"

#include <algorithm>

namespace arthro::simulation {
namespace {

struct NamedTargets {
  const std::vector<std::string>& operator()(const TrackStep& step) const { return step.path; }
  const std::vector<std::string>& operator()(const FollowStep& step) const { return step.path; }
  const std::vector<std::string>& operator()(const TransferStep& step) const { return step.bodies; }
  const std::vector<std::string>& operator()(const ResectStep& step) const { return step.regions; }
  const std::vector<std::string>& operator()(const StepBase& step) const { return step.targets; }
};

}  // namespace

int TargetIndex(const Exercise& exercise, const std::string& id) {
  const auto found = std::find_if(exercise.targets.begin(), exercise.targets.end(),
                                  [&](const ExerciseTarget& target) { return target.id == id; });
  return found == exercise.targets.end() ? -1 : static_cast<int>(found - exercise.targets.begin());
}

std::vector<int> TargetsOf(const Exercise& exercise, const ExerciseStep& step) {
  std::vector<int> targets;
  for (const std::string& id : std::visit(NamedTargets{}, step))
    targets.push_back(TargetIndex(exercise, id));
  if (const auto* recover = std::get_if<RecoverStep>(&step))
    targets.assign(1, TargetIndex(exercise, recover->source));
  std::erase(targets, -1);
  return targets;
}

int StepIndex(const Exercise& exercise, const std::string& id) {
  const auto found = std::find_if(exercise.steps.begin(), exercise.steps.end(),
                                  [&](const ExerciseStep& step) { return BaseOf(step).id == id; });
  return found == exercise.steps.end() ? -1 : static_cast<int>(found - exercise.steps.begin());
}

std::optional<glm::dvec3> PlaceOf(const Exercise& exercise, const AttemptFrame& frame, int target) {
  if (target < 0) return std::nullopt;
  const auto i = static_cast<std::size_t>(target);
  if (target < frame.sight.targets) {
    const PointSight& sight = frame.sight.target[i];
    return sight.is_gone ? std::nullopt : std::optional(glm::dvec3(sight.place));
  }
  return exercise.targets[i].ball;
}

std::vector<Ball> LooseBodiesIn(std::span<const ExerciseTarget> targets,
                                const AttemptFrame& frame) {
  std::vector<Ball> bodies;
  const auto seen = static_cast<std::size_t>(std::max(frame.sight.targets, 0));
  for (std::size_t i = 0; i < std::min(targets.size(), seen); ++i)
    if (targets[i].is_loose)
      bodies.push_back({glm::dvec3(frame.sight.target[i].place), targets[i].radius});
  return bodies;
}

bool UsesInstrument(const ExerciseStep& step) {
  if (const auto* track = std::get_if<TrackStep>(&step)) return track->by == StepBy::kTip;
  if (const auto* follow = std::get_if<FollowStep>(&step)) return follow->by == StepBy::kTip;
  return std::holds_alternative<ProbeStep>(step) || std::holds_alternative<MeasureStep>(step) ||
         std::holds_alternative<TransferStep>(step) || std::holds_alternative<ResectStep>(step) ||
         std::holds_alternative<RecoverStep>(step);
}

}  // namespace arthro::simulation
