#include "app/steps/lessons/exercise_edit.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "simulation/core/units.h"
#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/metrics/metric_words.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
namespace {

std::vector<Exercise>& ExercisesOf(authoring::Document& document) {
  return document.scene.exercises;
}

std::string FreeId(const std::vector<Exercise>& all, const std::string& name) {
  std::vector<std::string> ids;
  ids.reserve(all.size());
  for (const Exercise& exercise : all) ids.push_back(exercise.id);
  return FreeName(ids, name);
}

// The first version that no content under this id has had in this run of the program, so that two
// contents never share an activity of the records, after an undo either.
int FreshVersion(EditorState& state, const std::string& id, int before) {
  int& newest = state.steps.lessons->newest_versions[id];
  return newest = std::max(newest, before) + 1;
}

// The pose in which the author holds the scope.
StartPose ViewOf(const EditorState& state) {
  return {state.scope.latitude, state.scope.longitude, state.scope.roll, state.scope.depth};
}

}  // namespace

std::string FreeName(std::span<const std::string> taken, const std::string& name) {
  for (int number = 1;; ++number) {
    std::string id = fmt::format("{}-{}", name, number);
    if (std::ranges::count(taken, id) == 0) return id;
  }
}

bool HasExercise(const EditorState& state) {
  return InEditor(state) && ChosenExercise(state) != nullptr;
}

void EditExercise(EditorState& state, const std::string& name, const std::string& merge_key,
                  const std::function<void(Exercise&)>& change) {
  const Exercise* const now = ChosenExercise(state);
  if (now == nullptr) return;
  const auto chosen = static_cast<std::size_t>(state.steps.lessons->chosen);
  const Exercise& before = *now;
  Exercise changed = before;
  change(changed);
  if (changed == before) return;
  LessonsStep& step = *state.steps.lessons;
  const bool is_dragged = !merge_key.empty() && state.dragging && step.drag_key == merge_key;
  if (!is_dragged) {
    state.history.EndMerge();
    changed.version = FreshVersion(state, changed.id, before.version);
  }
  Edit(state, name, merge_key,
       [&](authoring::Document& document) { std::swap(ExercisesOf(document)[chosen], changed); });
  step.drag_key = merge_key;
  state.dragging = !merge_key.empty();
}

void AddExercise(EditorState& state) {
  Exercise exercise;
  exercise.setup.scope = ViewOf(state);
  exercise.id = FreeId(state.document().scene.exercises, "exercise");
  exercise.version = FreshVersion(state, exercise.id, 0);
  exercise.title = "New exercise";
  Edit(state, "New exercise", "",
       [&](authoring::Document& document) { ExercisesOf(document).push_back(exercise); });
  LessonsStep& step = *state.steps.lessons;
  step.chosen = static_cast<int>(state.document().scene.exercises.size()) - 1;
  step.target = step.step = step.criterion = step.zone = -1;
}

void BeginWithThisView(EditorState& state) {
  EditExercise(state, "View at the begin", "",
               [&](Exercise& changed) { changed.setup.scope = ViewOf(state); });
  state.message = "An attempt begins with the view that the picture shows now.";
}

void CopyExercise(EditorState& state) {
  Exercise copy = *ChosenExercise(state);
  copy.id = FreeId(state.document().scene.exercises, copy.id);
  copy.title += " (copy)";
  copy.version = FreshVersion(state, copy.id, 0);
  Edit(state, "Copy exercise", "",
       [&](authoring::Document& document) { ExercisesOf(document).push_back(copy); });
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

}  // namespace arthro::app
