// Pages of a lesson: what the exercise asks for, the attempt that runs, and its result.
#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/panels/options_panel.h"
#include "app/state/clock_words.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/lessons/value_words.h"

namespace arthro::app {
namespace {

using simulation::AttemptOutcome;
using simulation::StripState;

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

void Briefing(Ui& ui, EditorState& state, const Exercise& exercise) {
  LargeText(ui, exercise.title);
  Text(ui, exercise.brief);
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
  CommandButton(ui, state, "begin-exercise", {ui.Px(160), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "trainee-page", {ui.Px(170), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "close-lesson", {ui.Px(120), ui.Px(44)});
}

const ExerciseStep* StepUnderWay(const simulation::StepEngine& engine) {
  const int step = engine.strip().step;
  const auto& steps = engine.exercise().steps;
  return step >= 0 && step < static_cast<int>(steps.size()) ? &steps[static_cast<std::size_t>(step)]
                                                            : nullptr;
}

void ForceBand(Ui& ui, const StripState& strip) {
  if (!strip.force_band) return;
  const glm::dvec2 band = *strip.force_band;
  const bool is_within = strip.force >= band.x && strip.force <= band.y;
  QuietText(
      ui, fmt::format("Force {:.1f} N, asked for {:.1f} to {:.1f} N", strip.force, band.x, band.y));
  const double full = 1.5 * band.y;
  MarkedBar(ui, "Force asked for", std::min(1.0, strip.force / full), is_within ? kGood : kWarning,
            band.x / full, fmt::format("{:.1f} N", strip.force));
  // The band itself lies over the bar, from the mark of its lower end to that of its upper one.
  constexpr unsigned kBandShade = 0x4050C850;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const auto at = [&](double force) {
    return low.x + (high.x - low.x) * static_cast<float>(force / full);
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({at(band.x), low.y}, {at(band.y), high.y}, kBandShade);
  draw->AddLine({at(band.y), low.y}, {at(band.y), high.y}, OnGround(kBright), ui.Px(2));
}

void Answers(Ui& ui, EditorState& state, const ExerciseStep& step) {
  const auto* question = std::get_if<AnswerStep>(&step);
  if (question == nullptr) return;
  Text(ui, question->question);
  for (std::size_t i = 0; i < question->choices.size(); ++i)
    if (Button(ui, question->choices[i].text, true, {-FLT_MIN, ui.Px(40)}))
      Act(state, {.kind = simulation::ActKind::kAnswer, .answer = static_cast<int>(i), .note = {}});
}

void UnderWay(Ui& ui, EditorState& state) {
  const simulation::StepEngine& engine = state.steps.lessons->running->engine;
  const StripState& strip = engine.strip();
  const Exercise& exercise = engine.exercise();
  Heading(ui, exercise.title);
  QuietText(ui, "Time");
  LargeText(ui, ClockWords(strip.time));
  QuietText(ui, fmt::format("{} of {} steps done", strip.done, exercise.steps.size()));
  if (const ExerciseStep* step = StepUnderWay(engine)) {
    const std::string& text = BaseOf(*step).text;
    Heading(ui, text.empty() ? WordsOfField(KindOf(*step)) : text);
    MarkedBar(ui, "Progress", strip.progress, kGood, 0,
              fmt::format("{:.0f} %", 100 * strip.progress));
    if (strip.step_time_left)
      QuietText(ui, fmt::format("{:.0f} s left", std::ceil(*strip.step_time_left)));
    ForceBand(ui, strip);
    Answers(ui, state, *step);
  } else {
    Text(ui, "Free practice: end the attempt when you are ready.");
  }
  Gap(ui);
  if (!strip.force_band) QuietText(ui, fmt::format("Force on the tip {:.2f} N", strip.force));
  const float foot = 2 * ui.Px(50);
  const float free = ImGui::GetContentRegionAvail().y - foot;
  if (free > 0) ImGui::Dummy({0, free - ImGui::GetStyle().ItemSpacing.y});
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  CommandButton(ui, state, "attempt-hint", {half, ui.Px(44)});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "attempt-mark", {half, ui.Px(44)});
  CommandButton(ui, state, "end-attempt", {-FLT_MIN, ui.Px(44)});
}

const char* OutcomeWords(AttemptOutcome outcome) {
  switch (outcome) {
    case AttemptOutcome::kPassed:
      return "Passed";
    case AttemptOutcome::kFailed:
      return "Not passed";
    case AttemptOutcome::kStopped:
      return "Stopped";
    case AttemptOutcome::kVoid:
      return "Void";
    case AttemptOutcome::kRunning:
      break;
  }
  return "Running";
}

constexpr auto kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;

// A value does not stand far from its name on a wide screen.
ImVec2 TableSize(const Ui& ui) {
  return {std::min(ImGui::GetContentRegionAvail().x, ui.Px(760)), 0};
}

void Criteria(Ui& ui, const simulation::AttemptResult& result) {
  if (!ImGui::BeginTable("criteria", 4, kTable, TableSize(ui))) return;
  for (const simulation::CriterionResult& criterion : result.criteria) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ColouredText(ui, criterion.is_met ? "met" : "not met", criterion.is_met ? kGood : kBad);
    ImGui::TableNextColumn();
    Text(ui, MetricWords(criterion.metric, criterion.part));
    ImGui::TableNextColumn();
    Text(ui, ValueOfMetric(criterion.metric, criterion.value, {criterion.low, criterion.high}));
    ImGui::TableNextColumn();
    QuietText(ui, LimitsOfMetric(criterion.metric, {criterion.low, criterion.high}) +
                      (criterion.is_start_value ? " (start value)" : ""));
  }
  ImGui::EndTable();
}

void Measured(Ui& ui, const simulation::AttemptResult& result) {
  if (!ImGui::BeginTable("measured", 2, kTable, TableSize(ui))) return;
  for (const simulation::MetricValue& value : result.metrics) {
    if (!value.value || value.metric == nullptr) continue;
    const std::string id(value.metric->id);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    Text(ui, MetricWords(id, value.part));
    ImGui::TableNextColumn();
    Text(ui, ValueOfMetric(id, value.value));
  }
  ImGui::EndTable();
}

// Commands at the foot of a page, in as many rows as they need.
struct FootCommand {
  const char* id;
  float width;  // px at scale 1
};
constexpr FootCommand kSummaryFoot[] = {{"repeat-exercise", 120}, {"attempt-debrief", 130},
                                        {"attempt-report", 150},  {"use-as-expert", 160},
                                        {"trainee-page", 150},    {"instructor-page", 170},
                                        {"close-lesson", 110}};

// Calls `draw(command, begins_row)` for each; returns the number of rows.
template <class Draw>
int InRows(const Ui& ui, std::span<const FootCommand> commands, float room, const Draw& draw) {
  const float between = ImGui::GetStyle().ItemSpacing.x;
  int rows = 0;
  float left = 0;
  for (const FootCommand& command : commands) {
    const bool begins_row = rows == 0 || left < ui.Px(command.width) + between;
    if (begins_row) {
      ++rows;
      left = room;
    }
    left -= ui.Px(command.width) + between;
    draw(command, begins_row);
  }
  return rows;
}

void Summary(Ui& ui, EditorState& state, const FinishedAttempt& attempt) {
  const auto& result = attempt.result;
  LargeText(ui, OutcomeWords(result.outcome),
            result.outcome == AttemptOutcome::kPassed ? kGood : kWarning);
  Text(ui, attempt.exercise.title + ", " + ClockWords(result.duration));
  if (!result.reason.empty()) Text(ui, result.reason);
  if (!attempt.started.empty())
    QuietText(ui, fmt::format("Trainee {}, {} UTC, {}", attempt.trainee, TimeWords(attempt.started),
                              attempt.is_robot  ? "robot"
                              : attempt.is_test ? "test"
                                                : "practice"));
  Notices(ui, attempt);
  if (!attempt.kept.empty())
    ColouredText(ui, attempt.kept, HasUnkeptAttempt(state) ? kBad : kQuiet);
  if (HasUnkeptAttempt(state)) CommandButton(ui, state, "keep-attempt", {ui.Px(170), ui.Px(44)});
  Gap(ui);
  // The commands stay in sight below the values.
  const float room = ImGui::GetContentRegionAvail().x + ImGui::GetStyle().ItemSpacing.x;
  const int rows = InRows(ui, kSummaryFoot, room, [](const FootCommand&, bool) {});
  const float foot = static_cast<float>(rows) * ui.Px(50) + ui.Px(4);
  ImGui::BeginChild("values", {0, std::max(ui.Px(80), ImGui::GetContentRegionAvail().y - foot)});
  if (!result.criteria.empty()) {
    Heading(ui, "Criteria");
    Criteria(ui, result);
    Gap(ui);
  }
  Heading(ui, "Measured");
  Measured(ui, result);
  ImGui::EndChild();
  InRows(ui, kSummaryFoot, room, [&](const FootCommand& command, bool begins_row) {
    if (!begins_row) ImGui::SameLine();
    CommandButton(ui, state, command.id, {ui.Px(command.width), ui.Px(44)});
  });
}

}  // namespace

void LessonPagePanel(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "lesson", area, kPageWindow);
  LessonsStep& step = *state.steps.lessons;
  if (step.running) return UnderWay(ui, state);
  if (step.page == LessonPage::kStart) return TraineePage(ui, state);
  if (step.page == LessonPage::kInstructor) return InstructorPage(ui, state);
  if (step.page == LessonPage::kBriefing && ChosenExercise(state) != nullptr)
    return Briefing(ui, state, *ChosenExercise(state));
  if (step.finished) Summary(ui, state, *step.finished);
}

}  // namespace arthro::app
