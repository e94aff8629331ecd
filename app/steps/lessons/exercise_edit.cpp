#include "app/steps/lessons/exercise_edit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/state/edits.h"
#include "simulation/core/units.h"
#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/metrics/metric_words.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
namespace {

constexpr double kHintAfter = 20;  // s, as in the exercises of the demo scene

void GiveHint(StepBase& base) {
  base.cue = CueKind::kOutline;
  if (base.cue_after == 0) base.cue_after = kHintAfter;
}

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

// The pose in which the author holds the scope.
StartPose ViewOf(const EditorState& state) {
  return {state.scope.latitude, state.scope.longitude, state.scope.roll, state.scope.depth};
}

// Lists of the step that name targets.
std::vector<std::vector<std::string>*> NamesIn(ExerciseStep& step) {
  std::vector<std::vector<std::string>*> lists = {&BaseOf(step).targets};
  if (auto* track = std::get_if<TrackStep>(&step)) lists.push_back(&track->path);
  if (auto* follow = std::get_if<FollowStep>(&step)) lists.push_back(&follow->path);
  if (auto* transfer = std::get_if<TransferStep>(&step)) lists.push_back(&transfer->bodies);
  if (auto* resect = std::get_if<ResectStep>(&step)) lists.push_back(&resect->regions);
  return lists;
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
  Edit(state, "New exercise", "", [&](authoring::Document& document) {
    Exercise exercise;
    exercise.setup.scope = ViewOf(state);
    exercise.id = FreeId(ExercisesOf(document), "exercise");
    exercise.title = "New exercise";
    ExercisesOf(document).push_back(exercise);
  });
  LessonsStep& step = *state.steps.lessons;
  step.chosen = static_cast<int>(state.document().scene.exercises.size()) - 1;
  step.target = step.step = step.criterion = -1;
}

void BeginWithThisView(EditorState& state) {
  EditExercise(state, "View at the begin", "",
               [&](Exercise& changed) { changed.setup.scope = ViewOf(state); });
  state.message = "An attempt begins with the view that the picture shows now.";
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

void RenameTarget(EditorState& state, int target, const std::string& name) {
  const auto& targets = ChosenExercise(state)->targets;
  const std::string old = targets[static_cast<std::size_t>(target)].id;
  if (name == old) return;
  if (name.empty() || std::ranges::count(targets, name, &ExerciseTarget::id) > 0) {
    state.message = name.empty() ? "A target needs a name."
                                 : fmt::format("Another target is called \"{}\".", name);
    return;
  }
  EditExercise(state, "Rename target", "", [&](Exercise& changed) {
    const auto rename = [&](std::string& id) {
      if (id == old) id = name;
    };
    rename(changed.targets[static_cast<std::size_t>(target)].id);
    for (AvoidZone& zone : changed.avoid) rename(zone.target);
    for (ExerciseStep& step : changed.steps) {
      for (std::vector<std::string>* ids : NamesIn(step)) std::ranges::for_each(*ids, rename);
      if (auto* recover = std::get_if<RecoverStep>(&step)) rename(recover->source);
    }
  });
}

void AddStep(EditorState& state, int kind) {
  EditExercise(state, "New step", "", [&](Exercise& changed) {
    ExerciseStep step =
        StepOfKind(kind, std::make_index_sequence<std::variant_size_v<ExerciseStep>>());
    StepBase& base = BaseOf(step);
    base.id = FreeStepId(changed.steps);
    GiveHint(base);
    for (const ExerciseTarget& target : changed.targets) base.targets.push_back(target.id);
    changed.steps.push_back(std::move(step));
  });
  state.steps.lessons->step = static_cast<int>(ChosenExercise(state)->steps.size()) - 1;
}

void SetHint(EditorState& state, int step, bool has_hint) {
  EditExercise(state, "Hint of the step", "", [&](Exercise& changed) {
    StepBase& base = BaseOf(changed.steps[static_cast<std::size_t>(step)]);
    if (has_hint)
      GiveHint(base);
    else
      base.cue = CueKind::kNone, base.cue_after = 0;
  });
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
    // The usual metrics in turn; another one is chosen on the page.
    std::string metric = "task_time";
    for (const char* usual : {"tool_loss", "peak_force", "task_time"})
      if (std::ranges::count(changed.criteria, usual, &Criterion::metric) == 0) metric = usual;
    changed.criteria.push_back(StartCriterion(metric));
  });
  state.steps.lessons->criterion = static_cast<int>(ChosenExercise(state)->criteria.size()) - 1;
}

Criterion StartCriterion(const std::string& metric) {
  constexpr double kTime = 120, kLength = 3e-3, kArea = 1e-5, kVolume = 4e-9, kShare = 0.9;
  Criterion criterion;
  criterion.metric = metric;
  if (const auto parts = simulation::PartsOf(metric); !parts.empty())
    criterion.part = parts.front();
  criterion.source = "start value";
  for (const simulation::Metric& known : simulation::EveryMetric()) {
    if (known.id != metric) continue;
    if (known.is_more_better) {
      criterion.min = known.unit.empty() ? kShare : kLength;
      return criterion;
    }
    if (known.unit == "s") criterion.max = kTime;
    if (known.unit == "N") {
      criterion.max = simulation::kSafeProbingForce;
      criterion.source = "safe maximum of probing, PMC3023859";
    }
    if (known.unit == "m") criterion.max = kLength;
    if (known.unit == "m2") criterion.max = kArea;
    if (known.unit == "m3") criterion.max = kVolume;
    if (known.unit == "rad") criterion.max = 10 * kRadianPerDegree;
  }
  if (!criterion.max) criterion.max = 0;
  return criterion;
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
