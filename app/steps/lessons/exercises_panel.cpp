// Author's page of exercises: their list, and title, targets, steps and criteria of the chosen one.
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/options_panel.h"
#include "app/state/edits.h"
#include "app/steps/lessons/exercise_edit.h"
#include "app/steps/lessons/value_words.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
namespace {

// Numbers and choices of a step; texts and lists have fields of their own.
struct StepFields {
  OptionsPanelVisitor& panel;
  template <class T, class R>
  void operator()(const char* name, T& field, const R& rule, const char* unit, const char* help) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
      if constexpr (std::is_same_v<R, Range>) panel(name, field, rule, unit, help);
    } else if constexpr (std::is_same_v<T, glm::dvec2> && std::is_same_v<R, Range>) {
      panel((std::string(name) + "_from").c_str(), field.x, rule, unit, help);
      panel((std::string(name) + "_to").c_str(), field.y, rule, unit, help);
    }
  }
};

std::string PlaceWords(const ExerciseTarget& target) {
  switch (KindOf(target)) {
    case TargetKind::kBearing:
      return "on the relief";
    case TargetKind::kPoint:
      return "on " + target.on;
    case TargetKind::kBall:
      return "a ball";
    case TargetKind::kRegions:
      return "regions of " + target.on;
  }
  return "";
}

void List(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  const auto& exercises = state.document().scene.exercises;
  if (exercises.empty())
    QuietText(ui, "This scene has no exercise. Add one, and click its targets in the picture.");
  // Without a scroll bar of its own, beside that of the panel.
  for (std::size_t i = 0; i < exercises.size(); ++i)
    if (ListEntry(ui, fmt::format("{}##{}", exercises[i].title, i),
                  static_cast<int>(i) == step.chosen)) {
      step.chosen = static_cast<int>(i);
      step.target = step.step = step.criterion = -1;
    }
  CommandButton(ui, state, "new-exercise", {-FLT_MIN, 0});
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  CommandButton(ui, state, "copy-exercise", {half, 0});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "remove-exercise", {half, 0});
  CommandButton(ui, state, "exercise-briefing", {-FLT_MIN, ui.Px(44)});
  CommandButton(ui, state, "trainee-page", {-FLT_MIN, 0});
}

void Words(Ui& ui, EditorState& state, const Exercise& exercise) {
  std::string title = exercise.title, brief = exercise.brief;
  if (TextField(ui, "Title of the exercise", title))
    EditExercise(state, "Title", "exercise-title", [&](Exercise& e) { e.title = title; });
  if (TextField(ui, "What the trainee is asked to do", brief))
    EditExercise(state, "Brief", "exercise-brief", [&](Exercise& e) { e.brief = brief; });
}

void Targets(Ui& ui, EditorState& state, const Exercise& exercise) {
  LessonsStep& step = *state.steps.lessons;
  for (std::size_t i = 0; i < exercise.targets.size(); ++i) {
    const ExerciseTarget& target = exercise.targets[i];
    if (ListEntry(ui, fmt::format("{}, {}##target{}", target.id, PlaceWords(target), i),
                  static_cast<int>(i) == step.target)) {
      step.target = static_cast<int>(i);
      step.takes_target = false;
    }
  }
  if (Button(ui, "Add a target by a click", true, {-FLT_MIN, 0})) AddTarget(state);
  const Exercise& now = *ChosenExercise(state);
  if (step.target < 0 || step.target >= static_cast<int>(now.targets.size())) return;
  const auto chosen = static_cast<std::size_t>(step.target);
  if (ToggleButton(ui, "Place it by a click", step.takes_target, true, {-FLT_MIN, 0},
                   "Click in the scope's picture where the target lies."))
    step.takes_target = !step.takes_target;
  double mm = 1e3 * now.targets[chosen].radius;
  const Change change = Slider(ui, "Radius of the target", mm, 0.5, 10, "%.1f mm");
  if (change)
    EditExercise(state, "Radius of the target", "target-radius",
                 [&](Exercise& e) { e.targets[chosen].radius = 1e-3 * mm; });
  if (change.released) EndDrag(state);
  if (Button(ui, "Remove this target", true, {-FLT_MIN, 0})) RemoveTarget(state, step.target);
}

template <std::size_t... kinds>
std::vector<std::string> KindWords(std::index_sequence<kinds...>) {
  return {WordsOfField(std::variant_alternative_t<kinds, ExerciseStep>::kType)...};
}

void ChosenStep(Ui& ui, EditorState& state, std::size_t chosen) {
  const Exercise& exercise = *ChosenExercise(state);
  ExerciseStep changed = exercise.steps[chosen];
  QuietText(ui, std::visit([](const auto& kind) { return std::string(kind.kHelp); }, changed));
  std::string text = BaseOf(changed).text;
  if (TextField(ui, "Words of the step", text))
    EditExercise(state, "Words of the step", "step-text",
                 [&](Exercise& e) { BaseOf(e.steps[chosen]).text = text; });
  for (const ExerciseTarget& target : exercise.targets) {
    auto ids = BaseOf(changed).targets;
    bool is_used = std::find(ids.begin(), ids.end(), target.id) != ids.end();
    if (Checkbox(ui, "With " + target.id, is_used))
      EditExercise(state, "Targets of the step", "", [&](Exercise& e) {
        auto& named = BaseOf(e.steps[chosen]).targets;
        if (is_used)
          named.push_back(target.id);
        else
          std::erase(named, target.id);
      });
  }
  OptionsPanelVisitor panel{ui};
  StepFields fields{panel};
  std::visit([&](auto& kind) { kind.Visit(fields); }, changed);
  if (!panel.changed_field.empty())
    EditExercise(state, panel.changed_field, "step-" + panel.changed_field,
                 [&](Exercise& e) { std::swap(e.steps[chosen], changed); });
  if (panel.released) EndDrag(state);
}

void Steps(Ui& ui, EditorState& state, const Exercise& exercise) {
  LessonsStep& step = *state.steps.lessons;
  for (std::size_t i = 0; i < exercise.steps.size(); ++i) {
    const StepBase& base = BaseOf(exercise.steps[i]);
    if (ListEntry(ui,
                  fmt::format("{}. {}: {}##step{}", i + 1, KindOf(exercise.steps[i]),
                              base.text.empty() ? base.id : base.text, i),
                  static_cast<int>(i) == step.step))
      step.step = static_cast<int>(i);
  }
  int kind = -1;
  if (Combo(ui, "Add a step", kind,
            KindWords(std::make_index_sequence<std::variant_size_v<ExerciseStep>>()),
            "A step takes all targets at first."))
    AddStep(state, kind);
  if (step.step < 0 || step.step >= static_cast<int>(ChosenExercise(state)->steps.size())) return;
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ui.Px(6)) / 3;
  if (Button(ui, "Earlier", step.step > 0, {third, 0})) MoveStep(state, step.step, -1);
  ImGui::SameLine(0, ui.Px(6));
  if (Button(ui, "Later", true, {third, 0})) MoveStep(state, step.step, 1);
  ImGui::SameLine(0, ui.Px(6));
  if (Button(ui, "Remove step", true, {third, 0})) return RemoveStep(state, step.step);
  ChosenStep(ui, state, static_cast<std::size_t>(step.step));
}

void Criteria(Ui& ui, EditorState& state, const Exercise& exercise) {
  LessonsStep& step = *state.steps.lessons;
  for (std::size_t i = 0; i < exercise.criteria.size(); ++i) {
    const Criterion& criterion = exercise.criteria[i];
    if (ListEntry(ui,
                  fmt::format("{} {}##criterion{}", MetricWords(criterion.metric, criterion.part),
                              LimitsOfMetric(criterion.metric, criterion.min, criterion.max), i),
                  static_cast<int>(i) == step.criterion))
      step.criterion = static_cast<int>(i);
  }
  if (Button(ui, "Add a criterion", true, {-FLT_MIN, 0})) AddCriterion(state);
  const Exercise& now = *ChosenExercise(state);
  if (step.criterion < 0 || step.criterion >= static_cast<int>(now.criteria.size())) return;
  const auto chosen = static_cast<std::size_t>(step.criterion);
  Criterion changed = now.criteria[chosen];
  std::vector<std::string> words;
  int metric = -1;
  for (const simulation::Metric& known : simulation::EveryMetric()) {
    if (known.id == changed.metric) metric = static_cast<int>(words.size());
    words.push_back(MetricWords(std::string(known.id), ""));
  }
  bool is_changed = false;
  if (Combo(ui, "Metric", metric, words)) {
    changed.metric = simulation::EveryMetric()[static_cast<std::size_t>(metric)].id;
    is_changed = true;
  }
  is_changed = TextField(ui, "Part", changed.part, "scope, instrument or both") || is_changed;
  double most = changed.max.value_or(0);
  if (NumberField(ui, "At most (SI units)", most, 0.1, 0, 1e6, "%.4g")) {
    changed.max = most;
    is_changed = true;
  }
  is_changed =
      TextField(ui, "Source of the limit", changed.source, "publication or person") || is_changed;
  if (is_changed)
    EditExercise(state, "Criterion", "criterion",
                 [&](Exercise& e) { e.criteria[chosen] = changed; });
  if (Button(ui, "Remove criterion", true, {-FLT_MIN, 0})) {
    EditExercise(state, "Remove criterion", "", [&](Exercise& e) {
      e.criteria.erase(e.criteria.begin() + static_cast<std::ptrdiff_t>(chosen));
    });
    step.criterion = -1;
  }
}

}  // namespace

void ExercisesPanel(Ui& ui, EditorState& state) {
  List(ui, state);
  if (ChosenExercise(state) == nullptr) return;
  Gap(ui);
  Words(ui, state, *ChosenExercise(state));
  if (Section(ui, "Targets", true)) Targets(ui, state, *ChosenExercise(state));
  if (Section(ui, "Steps of the exercise", true)) Steps(ui, state, *ChosenExercise(state));
  if (Section(ui, "Criteria of a pass")) Criteria(ui, state, *ChosenExercise(state));
}

}  // namespace arthro::app
