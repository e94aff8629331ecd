// Steps of the chosen exercise: their list, and the fields of the chosen one by its kind.
#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/options_panel.h"
#include "app/state/edits.h"
#include "app/steps/lessons/author/author_fields.h"
#include "app/steps/lessons/author/step_edit.h"

namespace arthro::app {
namespace {

constexpr double kUsualTime = 120, kUsualLength = 0.1;  // s, m; sliders end here
constexpr std::size_t kMostAnswers = 6;

// Fields of the kind of step: numbers, choices and targets. Words and what is seldom needed have
// fields of their own.
struct StepFields {
  OptionsPanelVisitor& panel;
  const Exercise& exercise;
  bool has_hint, uses_targets;

  template <class T, class R>
  void operator()(const char* name, T& field, const R& rule, const char* unit, const char* help) {
    const std::string key = name;
    if constexpr (std::is_same_v<T, double> && std::is_same_v<R, LeftOutAt<double, Range>>) {
      const bool is_of_hint = key == "cue_after";
      if (!is_of_hint || has_hint)
        panel(is_of_hint ? "hint_after" : name, field, Usual(rule.rule, field, unit), unit, help);
    } else if constexpr (std::is_same_v<T, double> && std::is_same_v<R, Range>) {
      panel(name, field, Usual(rule, field, unit), unit, help);
    } else if constexpr (std::is_same_v<T, int> && std::is_same_v<R, Range>) {
      if (key != "right") panel(name, field, rule, unit, help);
    } else if constexpr (std::is_same_v<T, glm::dvec2> && std::is_same_v<R, Range>) {
      ShowBand(name, field, rule, unit, help);
    } else if constexpr (std::is_same_v<T, StepBy>) {
      panel("led_by", field, rule, unit, help);
    } else if constexpr (std::is_same_v<T, bool>) {
      if (key == "view") panel("tip_in_sight", field, Any{}, unit, help);
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      if (key == "targets" && !uses_targets) return;
      if (TargetListField(panel.ui, exercise, name, WordsOfStepField(key), key == "path", field))
        Changed(name);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (key == "to" || key == "source") {
        if (TargetField(panel.ui, exercise, name, WordsOfStepField(key), field)) Changed(name);
      } else if (key == "question") {
        std::string words = field;
        if (TextField(panel.ui, "Question", words) && !words.empty()) field = words, Changed(name);
      }
    }
  }

 private:
  void Changed(const char* name) {
    panel.changed_field = WordsOfStepField(name);
    panel.released = true;
  }

  void ShowBand(const char* name, glm::dvec2& field, const Range& rule, const char* unit,
                const char* help) {
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

  // A slider of an hour would leave no time that can be set by hand.
  static Range Usual(Range range, double value, std::string_view unit) {
    if (unit == "s") range.max = std::min(range.max, std::max(kUsualTime, value));
    return range;
  }
};

template <std::size_t... kinds>
std::vector<std::string> KindWords(std::index_sequence<kinds...>) {
  return {WordsOfField(std::variant_alternative_t<kinds, ExerciseStep>::kType)...};
}

// Answers of a question, with the right one.
void AnswerFields(Ui& ui, EditorState& state, std::size_t chosen) {
  const AnswerStep before = std::get<AnswerStep>(ChosenExercise(state)->steps[chosen]);
  AnswerStep changed = before;
  std::vector<std::string> answers;
  for (std::size_t i = 0; i < changed.choices.size(); ++i) {
    std::string words = changed.choices[i].text;
    if (TextField(ui, fmt::format("Answer {}", i + 1), words) && !words.empty())
      changed.choices[i].text = words;
    answers.push_back(fmt::format("{}. {}", i + 1, changed.choices[i].text));
  }
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  if (Button(ui, "Add an answer", answers.size() < kMostAnswers, {half, 0}))
    changed.choices.push_back({"Another", ""});
  ImGui::SameLine(0, ui.Px(6));
  if (Button(ui, "Remove the last", answers.size() > 2, {half, 0})) changed.choices.pop_back();
  Combo(ui, "Right answer", changed.right, answers);
  changed.right = std::min(changed.right, static_cast<int>(changed.choices.size()) - 1);
  if (!(changed == before))
    EditExercise(state, "Answers", "", [&](Exercise& e) { e.steps[chosen] = changed; });
}

void ChosenStep(Ui& ui, EditorState& state, std::size_t chosen) {
  const Exercise& exercise = *ChosenExercise(state);
  ExerciseStep changed = exercise.steps[chosen];
  QuietText(ui, std::visit([](const auto& kind) { return std::string(kind.kHelp); }, changed));
  for (const std::string& sentence : LacksOfStep(state, chosen))
    ColouredText(ui, sentence, kWarning);
  std::string text = BaseOf(changed).text;
  if (TextField(ui, "Words of the step", text))
    EditExercise(state, "Words of the step", "",
                 [&](Exercise& e) { BaseOf(e.steps[chosen]).text = text; });
  int cue = static_cast<int>(BaseOf(changed).cue);
  if (Combo(ui, "Hint of the step", cue,
            {"No hint", "Name of the target", "Arrow to the target", "Outline of the target",
             "Way of the expert"},
            "Is shown when the trainee asks, and after a time by itself."))
    SetCue(state, static_cast<int>(chosen), static_cast<CueKind>(cue));
  OptionsPanelVisitor panel{ui, kUsualLength};
  StepFields fields{panel, exercise, BaseOf(changed).cue != CueKind::kNone, UsesTargets(changed)};
  std::visit([&](auto& kind) { kind.Visit(fields); }, changed);
  if (!panel.changed_field.empty())
    EditExercise(state, panel.changed_field, "step-" + panel.changed_field,
                 [&](Exercise& e) { std::swap(e.steps[chosen], changed); });
  if (panel.released) EndDrag(state);
  if (std::holds_alternative<AnswerStep>(ChosenExercise(state)->steps[chosen]))
    AnswerFields(ui, state, chosen);
  if (Section(ui, "More of this step")) MoreOfStep(ui, state, chosen);
}

}  // namespace

void StepsPanel(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  int kind = -1;
  if (Combo(ui, "Add a step", kind,
            KindWords(std::make_index_sequence<std::variant_size_v<ExerciseStep>>()),
            "A step takes the targets that suit it at first."))
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

}  // namespace arthro::app
