#include "app/steps/lessons/exercise_edit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/state/edits.h"

namespace arthro::app {
namespace {

std::vector<Exercise>& ExercisesOf(authoring::Document& document) {
  return document.scene.exercises;
}

// "name-2", "name-3" … that no entry of `all` has as its id.
template <class Entries>
std::string FreeId(const Entries& all, const std::string& name) {
  for (int number = 1;; ++number) {
    std::string id = fmt::format("{}-{}", name, number);
    if (std::none_of(all.begin(), all.end(), [&](const auto& entry) { return entry.id == id; }))
      return id;
  }
}

std::string FreeStepId(const std::vector<ExerciseStep>& steps) {
  std::vector<StepBase> bases;
  bases.reserve(steps.size());
  for (const ExerciseStep& step : steps) bases.push_back(BaseOf(step));
  return FreeId(bases, "step");
}

template <std::size_t... kinds>
ExerciseStep StepOfKind(int kind, std::index_sequence<kinds...>) {
  ExerciseStep step;
  ((static_cast<int>(kinds) == kind ? void(step = std::variant_alternative_t<kinds, ExerciseStep>())
                                    : void()),
   ...);
  return step;
}

}  // namespace

bool HasExercise(const EditorState& state) {
  return InEditor(state) && ChosenExercise(state) != nullptr;
}

void EditExercise(EditorState& state, const std::string& name, const std::string& merge_key,
                  const std::function<void(Exercise&)>& change) {
  const auto chosen = static_cast<std::size_t>(state.steps.lessons->chosen);
  const bool is_new_step = state.document().scene.exercises[chosen].version > 0;
  Edit(state, name, merge_key, [&](authoring::Document& document) {
    Exercise& exercise = ExercisesOf(document)[chosen];
    const Exercise before = exercise;
    change(exercise);
    if (is_new_step && !(exercise == before) && merge_key.empty()) ++exercise.version;
  });
}

void AddExercise(EditorState& state) {
  Edit(state, "New exercise", "", [](authoring::Document& document) {
    Exercise exercise;
    exercise.id = FreeId(ExercisesOf(document), "exercise");
    exercise.title = "New exercise";
    ExercisesOf(document).push_back(exercise);
  });
  LessonsStep& step = *state.steps.lessons;
  step.chosen = static_cast<int>(state.document().scene.exercises.size()) - 1;
  step.target = step.step = step.criterion = -1;
}

void CopyExercise(EditorState& state) {
  Exercise copy = *ChosenExercise(state);
  Edit(state, "Copy exercise", "", [&](authoring::Document& document) {
    copy.id = FreeId(ExercisesOf(document), copy.id);
    copy.title += " (copy)";
    copy.version = 1;
    ExercisesOf(document).push_back(copy);
  });
  state.steps.lessons->chosen = static_cast<int>(state.document().scene.exercises.size()) - 1;
}

void RemoveExercise(EditorState& state) {
  const int chosen = state.steps.lessons->chosen;
  Edit(state, "Remove exercise", "", [&](authoring::Document& document) {
    ExercisesOf(document).erase(ExercisesOf(document).begin() + chosen);
  });
  state.steps.lessons->chosen =
      std::min(chosen, static_cast<int>(state.document().scene.exercises.size()) - 1);
}

void AddTarget(EditorState& state) {
  const Exercise* exercise = ChosenExercise(state);
  if (exercise->targets.size() >= kMostTargets) {
    state.message = fmt::format("An exercise has at most {} targets.", kMostTargets);
    return;
  }
  EditExercise(state, "New target", "", [](Exercise& changed) {
    ExerciseTarget target;
    target.id = FreeId(changed.targets, "target");
    target.bearing = glm::dvec2(0.0);
    changed.targets.push_back(target);
  });
  LessonsStep& step = *state.steps.lessons;
  step.target = static_cast<int>(ChosenExercise(state)->targets.size()) - 1;
  step.takes_target = true;
  state.message = "Click in the scope's picture where the target lies.";
}

void RemoveTarget(EditorState& state, int target) {
  EditExercise(state, "Remove target", "", [&](Exercise& changed) {
    const std::string id = changed.targets[static_cast<std::size_t>(target)].id;
    changed.targets.erase(changed.targets.begin() + target);
    for (ExerciseStep& step : changed.steps) std::erase(BaseOf(step).targets, id);
    std::erase_if(changed.avoid, [&](const AvoidZone& zone) { return zone.target == id; });
  });
  state.steps.lessons->target = -1;
}

void AddStep(EditorState& state, int kind) {
  EditExercise(state, "New step", "", [&](Exercise& changed) {
    ExerciseStep step =
        StepOfKind(kind, std::make_index_sequence<std::variant_size_v<ExerciseStep>>());
    BaseOf(step).id = FreeStepId(changed.steps);
    for (const ExerciseTarget& target : changed.targets) BaseOf(step).targets.push_back(target.id);
    changed.steps.push_back(std::move(step));
  });
  state.steps.lessons->step = static_cast<int>(ChosenExercise(state)->steps.size()) - 1;
}

void RemoveStep(EditorState& state, int step) {
  EditExercise(state, "Remove step", "",
               [&](Exercise& changed) { changed.steps.erase(changed.steps.begin() + step); });
  state.steps.lessons->step = -1;
}

void MoveStep(EditorState& state, int step, int by) {
  const int other = step + by;
  if (other < 0 || other >= static_cast<int>(ChosenExercise(state)->steps.size())) return;
  EditExercise(state, "Move step", "", [&](Exercise& changed) {
    std::swap(changed.steps[static_cast<std::size_t>(step)],
              changed.steps[static_cast<std::size_t>(other)]);
  });
  state.steps.lessons->step = other;
}

void AddCriterion(EditorState& state) {
  EditExercise(state, "New criterion", "", [](Exercise& changed) {
    Criterion criterion;
    criterion.metric = "task_time";
    criterion.max = 120;
    criterion.source = "start value";
    changed.criteria.push_back(criterion);
  });
  state.steps.lessons->criterion = static_cast<int>(ChosenExercise(state)->criteria.size()) - 1;
}

bool TakesTarget(const EditorState& state) {
  return state.steps.lessons->takes_target && HasExercise(state) &&
         state.step == Step::kExercises && state.steps.lessons->target >= 0;
}

void PlaceTarget(EditorState& state, const authoring::Sight& sight,
                 const std::optional<TissueHit>& hit) {
  const auto relief = authoring::PointOnRelief(state.document(), sight);
  const auto& tissues = state.document().scene.tissues;
  const auto distance = [&](const glm::dvec3& x) {
    return glm::dot(x - sight.eye, sight.direction);
  };
  const Tissue* tissue = hit ? &tissues[static_cast<std::size_t>(hit->tissue)] : nullptr;
  const bool is_on_tissue =
      tissue != nullptr &&
      (!relief || distance(tissue->pose * hit->x_in_tissue) < distance(relief->x_in_portal));
  if (!is_on_tissue && !relief) {
    state.message = authoring::kNothingImaged;
    return;
  }
  const auto target = static_cast<std::size_t>(state.steps.lessons->target);
  EditExercise(state, "Place target", "", [&](Exercise& changed) {
    ExerciseTarget& placed = changed.targets[target];
    placed.bearing.reset(), placed.point.reset(), placed.ball.reset();
    placed.on.clear(), placed.regions.clear();
    if (is_on_tissue) {
      placed.on = tissue->name;
      placed.point = hit->x_in_tissue;
    } else {
      const glm::dvec3& x = relief->x_in_portal;
      placed.bearing = glm::dvec2(std::atan2(-x.y, std::hypot(x.x, x.z)), std::atan2(x.x, x.z));
    }
  });
  state.steps.lessons->takes_target = false;
  state.message = is_on_tissue ? "The target lies on \"" + tissue->name + "\" and moves with it."
                               : std::string("The target lies on the relief.");
}

}  // namespace arthro::app
