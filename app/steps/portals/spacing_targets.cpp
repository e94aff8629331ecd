#include "app/steps/portals/spacing_targets.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "app/steps/portals/portals_step.h"
#include "simulation/core/error.h"
#include "simulation/training/observe/exercise_targets.h"

namespace arthro::app {
namespace {

using SpacingKind = SpacingTarget::Kind;

glm::dvec3 PlaceInPortal(const LoadedScene& loaded, const SpacingTarget& target,
                         const simulation::DepthField& relief) {
  for (const Exercise& exercise : loaded.scene.exercises)
    for (const ExerciseTarget& candidate : exercise.targets) {
      if (exercise.id != target.exercise || candidate.id != target.name) continue;
      Exercise one;
      one.targets = {candidate};
      const auto place = simulation::PlacesOfTargets(loaded, one, relief).front();
      if (place.tissue < 0) return place.point;
      // The scale is applied to the frame of a body at rest.
      const Pose& pose = loaded.scene.tissues[static_cast<std::size_t>(place.tissue)].pose;
      return pose.quaternion * place.point + pose.position;
    }
  return glm::dvec3(0.0);
}

}  // namespace

std::string WordsOf(const SpacingTarget& target) {
  if (target.kind == SpacingKind::kRelief) return "relief";
  return target.kind == SpacingKind::kTissue ? target.name : target.exercise + ": " + target.name;
}

std::vector<SpacingTarget> EverySpacingTarget(const Scene& scene) {
  std::vector<SpacingTarget> every{{SpacingKind::kRelief, "", ""}};
  for (const Tissue& tissue : scene.tissues)
    every.push_back({SpacingKind::kTissue, "", tissue.name});
  for (const Exercise& exercise : scene.exercises)
    for (const ExerciseTarget& target : exercise.targets)
      every.push_back({SpacingKind::kExercise, exercise.id, target.id});
  return every;
}

std::vector<SpacingTarget> SpacingTargetsOf(const Scene& scene,
                                            const std::vector<std::string>& words) {
  const std::vector<SpacingTarget> every = EverySpacingTarget(scene);
  std::vector<SpacingTarget> chosen;
  for (const std::string& word : words) {
    const auto found =
        std::ranges::find(every, word, [](const SpacingTarget& target) { return WordsOf(target); });
    if (found == every.end()) {
      std::string names;
      for (const SpacingTarget& target : every)
        names += (names.empty() ? "" : ", ") + WordsOf(target);
      throw Error(Code::kBadArgument,
                  fmt::format("there is no target \"{}\"; name some of: {}", word, names));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

std::vector<SpacingTarget> ChosenSpacingTargets(const EditorState& state) {
  const Scene& scene = state.document().scene;
  const std::vector<SpacingTarget> every = EverySpacingTarget(scene);
  std::vector<SpacingTarget> chosen;
  for (const SpacingTarget& target : state.steps.portals->reach.targets)
    if (std::find(every.begin(), every.end(), target) != every.end()) chosen.push_back(target);
  if (!chosen.empty()) return chosen;
  if (scene.tissues.empty()) return {every.front()};
  const auto count = static_cast<int>(scene.tissues.size());
  const int tissue = state.tissue >= 0 && state.tissue < count ? state.tissue : 0;
  return {{SpacingKind::kTissue, "", scene.tissues[static_cast<std::size_t>(tissue)].name}};
}

bool IsChosen(const EditorState& state, const SpacingTarget& target) {
  const std::vector<SpacingTarget> chosen = ChosenSpacingTargets(state);
  return std::find(chosen.begin(), chosen.end(), target) != chosen.end();
}

void ToggleSpacingTarget(EditorState& state, const SpacingTarget& target) {
  std::vector<SpacingTarget> chosen = ChosenSpacingTargets(state);
  const auto found = std::find(chosen.begin(), chosen.end(), target);
  if (found == chosen.end())
    chosen.push_back(target);
  else if (chosen.size() > 1)
    chosen.erase(found);
  state.steps.portals->reach.targets = std::move(chosen);
}

PlacedTargets PlaceTargets(const LoadedScene& loaded, const std::vector<SpacingTarget>& targets) {
  PlacedTargets placed;
  std::optional<simulation::DepthField> relief;
  for (const SpacingTarget& target : targets) {
    if (target.kind == SpacingKind::kRelief) placed.targets.has_relief = true;
    if (target.kind == SpacingKind::kTissue)
      for (std::size_t i = 0; i < loaded.scene.tissues.size(); ++i)
        if (loaded.scene.tissues[i].name == target.name)
          placed.targets.tissues.push_back(static_cast<int>(i));
    if (target.kind != SpacingKind::kExercise) continue;
    if (!relief) relief = simulation::ReliefOf(loaded);
    placed.targets.points.push_back(static_cast<int>(placed.points.size()));
    placed.points.push_back(PlaceInPortal(loaded, target, *relief));
  }
  return placed;
}

}  // namespace arthro::app
