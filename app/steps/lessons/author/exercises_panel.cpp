// Author's page of exercises: their list, and words, targets, steps and criteria of the chosen one.
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/no_panorama.h"
#include "app/steps/lessons/author/author_fields.h"
#include "app/steps/lessons/author/step_edit.h"

namespace arthro::app {
namespace {

void List(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  const auto& exercises = state.document().scene.exercises;
  if (exercises.empty()) {
    QuietText(ui, "This scene has no exercise. Add one, and click its targets in the picture.");
  } else if (ChosenExercise(state) == nullptr) {
    step.chosen = 0;
    step.target = step.step = step.criterion = step.zone = -1;
  }
  // Without a scroll bar of its own, beside that of the panel.
  for (std::size_t i = 0; i < exercises.size(); ++i)
    if (ListEntry(ui, fmt::format("{}##{}", exercises[i].title, i),
                  static_cast<int>(i) == step.chosen)) {
      step.chosen = static_cast<int>(i);
      step.target = step.step = step.criterion = step.zone = -1;
      step.takes_target = false;
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
  const bool has_title =
      TextField(ui, "Title of the exercise", title, "as the list of exercises shows it");
  const bool has_brief =
      TextField(ui, "What the trainee is asked to do", brief, "as the briefing says it");
  if (has_title) EditExercise(state, "Title", "", [&](Exercise& e) { e.title = title; });
  if (has_brief) EditExercise(state, "Brief", "", [&](Exercise& e) { e.brief = brief; });
}

// First sentence about what the exercise lacks.
void Lacks(Ui& ui, EditorState& state) {
  const auto sentences = LacksOfExercise(state);
  if (sentences.empty()) return;
  ColouredText(ui, sentences.front(), kWarning);
  if (sentences.size() > 1) QuietText(ui, fmt::format("and {} more", sentences.size() - 1));
}

}  // namespace

void ExercisesPanel(Ui& ui, EditorState& state) {
  if (!state.document().panorama)
    return AskForPanorama(ui, state, "Exercises are made in a scene with a panorama.");
  List(ui, state);
  if (ChosenExercise(state) == nullptr) return;
  Gap(ui);
  Words(ui, state, *ChosenExercise(state));
  Lacks(ui, state);
  if (Section(ui, "Targets", true)) TargetsPanel(ui, state);
  if (Section(ui, "Steps of the exercise", true)) StepsPanel(ui, state);
  if (Section(ui, "Criteria of a pass")) CriteriaPanel(ui, state);
  if (Section(ui, "View and tools at the start")) StartPanel(ui, state);
  if (Section(ui, "More")) MorePanel(ui, state);
}

}  // namespace arthro::app
