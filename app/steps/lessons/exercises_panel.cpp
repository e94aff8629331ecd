// Author's page of exercises: their list, and title, targets, steps and criteria of the chosen one.
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/no_panorama.h"
#include "app/panels/options_panel.h"
#include "app/state/edits.h"
#include "app/steps/lessons/exercise_edit.h"

namespace arthro::app {
namespace {

constexpr double kUsualTime = 120, kUsualLength = 0.1;  // s, m; sliders end here

// Numbers and choices of a step; texts and lists have fields of their own.
struct StepFields {
  OptionsPanelVisitor& panel;
  bool has_hint;
  template <class T, class R>
  void operator()(const char* name, T& field, const R& rule, const char* unit, const char* help) {
    if constexpr (std::is_same_v<T, double> && std::is_same_v<R, LeftOutAt<double, Range>>) {
      const bool is_of_hint = std::string_view(name) == "cue_after";
      if (!is_of_hint || has_hint)
        panel(is_of_hint ? "hint_after" : name, field, Usual(rule.rule, field, unit), unit, help);
    } else if constexpr (std::is_same_v<T, double> && std::is_same_v<R, Range>) {
      panel(name, field, Usual(rule, field, unit), unit, help);
    } else if constexpr (std::is_same_v<T, int> && std::is_same_v<R, Range>) {
      panel(name, field, rule, unit, help);
    } else if constexpr (std::is_same_v<T, glm::dvec2> && std::is_same_v<R, Range>) {
      const double from_before = field.x;
      panel((std::string(name) + "_from").c_str(), field.x, rule, unit, help);
      panel((std::string(name) + "_to").c_str(), field.y, rule, unit, help);
      // The end that is moved takes the other one along.
      if (field.x > field.y) {
        if (field.x != from_before)
          field.y = field.x;
        else
          field.x = field.y;
      }
    }
  }

 private:
  // A slider of an hour would leave no time that can be set by hand.
  static Range Usual(Range range, double value, std::string_view unit) {
    if (unit == "s") range.max = std::min(range.max, std::max(kUsualTime, value));
    return range;
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
  if (exercises.empty()) {
    QuietText(ui, "This scene has no exercise. Add one, and click its targets in the picture.");
  } else if (ChosenExercise(state) == nullptr) {
    step.chosen = 0;
    step.target = step.step = step.criterion = -1;
  }
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

void Targets(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  // Above the list, so that it stays where it is while the list grows.
  if (Button(ui, "Add a target by a click", true, {-FLT_MIN, 0})) AddTarget(state);
  const auto targets = ChosenExercise(state)->targets;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const ExerciseTarget& target = targets[i];
    if (ListEntry(ui, fmt::format("{}, {}##target{}", target.id, PlaceWords(target), i),
                  static_cast<int>(i) == step.target)) {
      step.target = static_cast<int>(i);
      step.takes_target = false;
    }
  }
  const Exercise& now = *ChosenExercise(state);
  if (step.target < 0 || step.target >= static_cast<int>(now.targets.size())) return;
  const auto chosen = static_cast<std::size_t>(step.target);
  if (ToggleButton(ui, "Place it by a click", step.takes_target, true, {-FLT_MIN, 0},
                   "Click in the scope's picture where the target lies."))
    step.takes_target = !step.takes_target;
  std::string name = now.targets[chosen].id;
  if (TextField(ui, "Name of the target", name, "for example: tibial spine"))
    RenameTarget(state, step.target, name);
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
  bool has_hint = BaseOf(changed).cue != CueKind::kNone;
  if (Checkbox(ui, "With a hint", has_hint,
               "Shows the targets when the trainee asks, and after a time by itself."))
    SetHint(state, static_cast<int>(chosen), has_hint);
  OptionsPanelVisitor panel{ui, kUsualLength};
  StepFields fields{panel, has_hint};
  std::visit([&](auto& kind) { kind.Visit(fields); }, changed);
  if (!panel.changed_field.empty())
    EditExercise(state, panel.changed_field, "step-" + panel.changed_field,
                 [&](Exercise& e) { std::swap(e.steps[chosen], changed); });
  if (panel.released) EndDrag(state);
}

void Steps(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  int kind = -1;
  if (Combo(ui, "Add a step", kind,
            KindWords(std::make_index_sequence<std::variant_size_v<ExerciseStep>>()),
            "A step takes all targets at first."))
    AddStep(state, kind);
  const auto steps = ChosenExercise(state)->steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    std::string words = WordsOfField(KindOf(steps[i]));
    if (const std::string& text = BaseOf(steps[i]).text; !text.empty())
      words = fmt::format("{}: {}", words, text);
    if (ListEntry(ui, fmt::format("{}. {}##step{}", i + 1, words, i),
                  static_cast<int>(i) == step.step))
      step.step = static_cast<int>(i);
  }
  if (step.step < 0 || step.step >= static_cast<int>(ChosenExercise(state)->steps.size())) return;
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  const int last = static_cast<int>(ChosenExercise(state)->steps.size()) - 1;
  if (Button(ui, "Earlier", step.step > 0, {half, 0})) MoveStep(state, step.step, -1);
  ImGui::SameLine(0, ui.Px(6));
  if (Button(ui, "Later", step.step < last, {half, 0})) MoveStep(state, step.step, 1);
  if (Button(ui, "Remove step", true, {-FLT_MIN, 0})) return RemoveStep(state, step.step);
  ChosenStep(ui, state, static_cast<std::size_t>(step.step));
}

}  // namespace

void ExercisesPanel(Ui& ui, EditorState& state) {
  if (!state.document().panorama)
    return AskForPanorama(ui, state, "Exercises are made in a scene with a panorama.");
  List(ui, state);
  if (ChosenExercise(state) == nullptr) return;
  Gap(ui);
  Words(ui, state, *ChosenExercise(state));
  if (Button(ui, "Begin with this view", true, {-FLT_MIN, 0},
             "The scope begins an attempt where you hold it now."))
    BeginWithThisView(state);
  if (Section(ui, "Targets", true)) Targets(ui, state);
  if (Section(ui, "Steps of the exercise", true)) Steps(ui, state);
  if (Section(ui, "Criteria of a pass")) CriteriaPanel(ui, state);
}

}  // namespace arthro::app
