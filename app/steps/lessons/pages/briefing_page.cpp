// The briefing: what an exercise asks for, with what, and what a pass needs.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/options_panel.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/pages/lesson_picture.h"
#include "app/steps/lessons/pages/setup_words.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/lessons/value_words.h"

namespace arthro::app {
namespace {

// Rows of the criteria: what is measured, within which limits, and where they come from.
void AskedFor(Ui& ui, const Exercise& exercise) {
  if (exercise.criteria.empty()) {
    QuietText(ui, "No criterion: the attempt is passed when its steps are done.");
    return;
  }
  for (const Criterion& criterion : exercise.criteria) {
    Text(ui, fmt::format("{} {}", MetricWords(criterion.metric, criterion.part),
                         LimitsOfMetric(criterion.metric, {criterion.min, criterion.max})));
    if (!criterion.source.empty()) QuietText(ui, criterion.source);
  }
}

constexpr float kBriefPicture = 220;  // px at scale 1

}  // namespace

void BriefingPage(Ui& ui, EditorState& state, const LessonTexture& texture_of) {
  const Exercise& exercise = *ChosenExercise(state);
  // The commands stay in sight below what an exercise asks for.
  const float foot = ui.Px(50) + ui.Px(4);
  ImGui::BeginChild("asked", {0, std::max(ui.Px(80), ImGui::GetContentRegionAvail().y - foot)});
  LargeText(ui, exercise.title);
  Text(ui, exercise.brief);
  if (const std::string words = SetupWords(exercise.setup); !words.empty()) Text(ui, words);
  ShowLessonPicture(ui, state, exercise.picture, kBriefPicture, texture_of);
  Gap(ui);
  Heading(ui, "Steps");
  int number = 0;
  for (const ExerciseStep& step : exercise.steps)
    Text(ui,
         fmt::format("{}. {}", ++number,
                     BaseOf(step).text.empty() ? WordsOfField(KindOf(step)) : BaseOf(step).text));
  Gap(ui);
  Heading(ui, "A pass needs");
  AskedFor(ui, exercise);
  Gap(ui);
  const std::string& trainee = state.steps.lessons->records->trainee;
  Text(ui, trainee.empty() ? "No trainee is chosen: the attempt is not kept."
                           : "Kept for trainee " + trainee + ".");
  FreshStartBoard(state);
  if (const std::string why = WhyShut(state); !why.empty()) ColouredText(ui, why, kWarning);
  Checkbox(ui, "Test, for the gate", state.steps.lessons->is_test,
           "A test counts for the gate of the exercise; practice does not.");
  Gap(ui);
  ImGui::EndChild();
  CommandButton(ui, state, "begin-exercise", {ui.Px(160), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "begin-unscored", {ui.Px(160), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "trainee-page", {ui.Px(170), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "close-lesson", {ui.Px(120), ui.Px(44)});
}

}  // namespace arthro::app
