// Pages of a lesson: the one that is shown, and the result of an attempt.
#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/capital.h"
#include "app/state/clock_words.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/running_attempt.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/lessons/value_words.h"
#include "simulation/training/score/criteria.h"

namespace arthro::app {
namespace {

using simulation::AttemptOutcome;

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

// "z +1.2, n = 6": distance from the mean of the group; empty where the group has no such value.
std::string StandingWords(const FinishedAttempt& attempt, const std::string& metric,
                          const std::string& part) {
  for (const GroupStanding& standing : attempt.standings)
    if (standing.metric == metric && standing.part == part)
      return standing.z ? fmt::format("z {:+.1f}, n = {}", *standing.z, standing.n)
                        : fmt::format("n = {}", standing.n);
  return "";
}

void Measured(Ui& ui, const FinishedAttempt& attempt) {
  const auto& metrics = attempt.result.metrics;
  if (!attempt.group.empty())
    QuietText(ui, fmt::format("z: distance from the mean of {} in standard deviations; positive is "
                              "better. A group of fewer than {} has none.",
                              attempt.group, simulation::kSmallestGroup));
  if (ImGui::BeginTable("measured", attempt.group.empty() ? 2 : 3, kTable, TableSize(ui))) {
    for (const simulation::MetricValue& value : metrics) {
      if (!value.value || value.metric == nullptr) continue;
      const std::string id(value.metric->id);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      Text(ui, MetricWords(id, value.part));
      ImGui::TableNextColumn();
      Text(ui, ValueOfMetric(id, value.value));
      if (attempt.group.empty()) continue;
      ImGui::TableNextColumn();
      QuietText(ui, StandingWords(attempt, id, value.part));
    }
    ImGui::EndTable();
  }
  // Reasons of missing values, each once, with the metrics that it is true of.
  std::vector<std::pair<std::string, std::string>> missing;
  for (const simulation::MetricValue& value : metrics) {
    if (value.value || value.metric == nullptr || value.why_none.empty()) continue;
    const std::string words = MetricWords(std::string(value.metric->id), value.part);
    const auto known =
        std::ranges::find(missing, value.why_none, [](const auto& m) { return m.first; });
    if (known == missing.end())
      missing.emplace_back(value.why_none, words);
    else
      known->second += ", " + words;
  }
  if (missing.empty()) return;
  Gap(ui);
  Heading(ui, "Not measured");
  for (const auto& [why, words] : missing) {
    Text(ui, Capital(why) + ":");
    QuietText(ui, words);
  }
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
  if (attempt.is_unscored)
    LargeText(ui, "Not scored");
  else
    LargeText(ui, OutcomeWords(result.outcome),
              result.outcome == AttemptOutcome::kPassed ? kGood : kWarning);
  Text(ui, attempt.exercise.title + ", " + ClockWords(result.duration));
  if (!result.reason.empty() && !attempt.is_unscored) Text(ui, result.reason);
  const char* const mode = attempt.is_robot ? "robot" : attempt.is_test ? "test" : "practice";
  if (attempt.started.empty() && attempt.is_robot)
    QuietText(ui, mode);
  else if (!attempt.started.empty() && attempt.trainee.empty())
    QuietText(ui, fmt::format("{} UTC, {}", TimeWords(attempt.started), mode));
  else if (!attempt.started.empty())
    QuietText(ui, fmt::format("Trainee {}, {} UTC, {}", attempt.trainee, TimeWords(attempt.started),
                              mode));
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
  if (!result.criteria.empty() && !attempt.is_unscored) {
    Heading(ui, "Criteria");
    Criteria(ui, result);
    Gap(ui);
  }
  Heading(ui, "Measured");
  Measured(ui, attempt);
  ImGui::EndChild();
  InRows(ui, kSummaryFoot, room, [&](const FootCommand& command, bool begins_row) {
    if (!begins_row) ImGui::SameLine();
    CommandButton(ui, state, command.id, {ui.Px(command.width), ui.Px(44)});
  });
}

}  // namespace

void LessonPagePanel(Ui& ui, EditorState& state, const Area& area,
                     const LessonTexture& texture_of) {
  const FixedWindow window(ui, "lesson", area, kPageWindow);
  LessonsStep& step = *state.steps.lessons;
  if (step.running) return AttemptPage(ui, state, texture_of);
  if (step.page == LessonPage::kStart) return TraineePage(ui, state);
  if (step.page == LessonPage::kInstructor) return InstructorPage(ui, state);
  if (step.page == LessonPage::kBriefing && ChosenExercise(state) != nullptr)
    return BriefingPage(ui, state, texture_of);
  if (step.finished) Summary(ui, state, *step.finished);
}

}  // namespace arthro::app
