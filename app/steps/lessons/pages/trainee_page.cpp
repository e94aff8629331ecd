// The trainee's page: every exercise of the scene with the best result, the tries and its gate, and
// the earlier attempts at the chosen one.
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/keeping/start_board.h"
#include "app/steps/lessons/trainee.h"
#include "app/steps/lessons/value_words.h"

namespace arthro::app {
namespace {

constexpr float kNumberWidth = 76, kButtonWidth = 110;  // px at scale 1

void WhoPractises(Ui& ui, EditorState& state) {
  LessonRecords& records = *state.steps.lessons->records;
  StartBoard& board = *state.steps.lessons->start;
  if (!records.trainee.empty()) {
    LargeText(ui, records.trainee);
    if (Button(ui, "Change trainee", true, {ui.Px(160), 0})) ChangeTrainee(state);
    return;
  }
  LargeText(ui, "Who practises?");
  QuietText(ui, records.place.empty()
                    ? "This window keeps no records: attempts can be made, and are not kept."
                    : "Attempts are kept under a code, never under a name.");
  ImGui::PushItemWidth(ui.Px(220));
  TextField(ui, "Trainee's code", board.code, "for example T-7F3K");
  ImGui::PopItemWidth();
  const bool has_place = !records.place.empty();
  if (Button(ui, "Use this code", has_place && !board.code.empty(), {ui.Px(160), 0}))
    TakeTraineeCode(state, board.code);
  ImGui::SameLine();
  if (Button(ui, "New code", has_place, {ui.Px(120), 0}, "A code that nobody has yet."))
    SuggestTraineeCode(state);
  if (!board.unknown.empty()) {
    Text(ui, fmt::format("No trainee has the code {} yet.", board.unknown));
    if (Button(ui, "Add this trainee", true, {ui.Px(160), 0})) AddTraineeCode(state);
  }
}

void GateOfRow(Ui& ui, const ExerciseStanding& row) {
  if (!row.is_open) return ColouredText(ui, fmt::format("shut: pass \"{}\"", row.needed), kWarning);
  if (row.gate.is_open) return ColouredText(ui, "passed", kGood);
  QuietText(ui, row.gate.reason);
}

void Head(Ui& ui, const char* words) {
  ImGui::TableNextColumn();
  QuietText(ui, words);
}

void Exercises(Ui& ui, EditorState& state, const StartBoard& board) {
  LessonsStep& step = *state.steps.lessons;
  const auto& exercises = state.document().scene.exercises;
  if (exercises.empty()) return QuietText(ui, "This scene has no exercise.");
  if (!ImGui::BeginTable("exercises", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY,
                         {0, ImGui::GetContentRegionAvail().y}))
    return;
  ImGui::TableSetupColumn("exercise", ImGuiTableColumnFlags_WidthStretch, 3);
  ImGui::TableSetupColumn("best", ImGuiTableColumnFlags_WidthFixed, ui.Px(kNumberWidth));
  ImGui::TableSetupColumn("tries", ImGuiTableColumnFlags_WidthFixed, ui.Px(kNumberWidth));
  ImGui::TableSetupColumn("gate", ImGuiTableColumnFlags_WidthStretch, 2);
  ImGui::TableSetupColumn("start", ImGuiTableColumnFlags_WidthFixed, ui.Px(kButtonWidth));
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableNextRow();
  for (const char* words : {"Exercise", "Best time", "Attempts", "Gate", ""}) Head(ui, words);
  for (std::size_t i = 0; i < exercises.size() && i < board.rows.size(); ++i) {
    const ExerciseStanding& row = board.rows[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (ListEntry(ui, fmt::format("{}. {}##row{}", i + 1, exercises[i].title, i),
                  static_cast<int>(i) == step.chosen))
      step.chosen = static_cast<int>(i);
    ImGui::TableNextColumn();
    Text(ui, row.best_time ? ValueWords(row.best_time, "s") : "–");
    ImGui::TableNextColumn();
    Text(ui, row.tries == 0 ? "–" : fmt::format("{} / {}", row.passes, row.tries));
    ImGui::TableNextColumn();
    GateOfRow(ui, row);
    ImGui::TableNextColumn();
    if (Button(ui, fmt::format("Start##start{}", i), row.is_open, {-FLT_MIN, 0},
               "Read what it asks for, then begin."))
      StartExercise(state, static_cast<int>(i));
  }
  ImGui::EndTable();
}

void EarlierAttempts(Ui& ui, EditorState& state, const StartBoard& board) {
  Heading(ui, "Earlier attempts");
  const Exercise* chosen = ChosenExercise(state);
  if (chosen == nullptr) return QuietText(ui, "Choose an exercise to see the attempts at it.");
  Text(ui, chosen->title);
  if (board.attempts.empty()) return QuietText(ui, "No attempt yet.");
  std::string opened;
  for (const AttemptRecord& attempt : board.attempts)
    if (ListEntry(
            ui,
            fmt::format("{}  {}  {}##{}", TimeWords(attempt.started),
                        simulation::ToString(attempt.outcome),
                        attempt.duration ? ValueWords(attempt.duration, "s") : "", attempt.id),
            false))
      opened = attempt.id;
  QuietText(ui, "Choose an attempt to see its result and to look back at it.");
  if (!opened.empty()) Guarded(state, "Attempt", [&] { ShowStoredAttempt(state, opened); });
}

}  // namespace

void TraineePage(Ui& ui, EditorState& state) {
  const StartBoard& board = FreshStartBoard(state);
  const float left = ui.Px(330), foot = ui.Px(54);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  ImGui::BeginChild("who", {left, room.y - foot});
  WhoPractises(ui, state);
  if (!board.fault.empty()) ColouredText(ui, board.fault, kWarning);
  Gap(ui, 12);
  EarlierAttempts(ui, state, board);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.Px(16));
  ImGui::BeginChild("what", {0, room.y - foot});
  LargeText(ui, state.document().scene.title);
  Exercises(ui, state, board);
  ImGui::EndChild();
  CommandButton(ui, state, "close-lesson", {ui.Px(120), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "instructor-page", {ui.Px(170), ui.Px(44)});
}

}  // namespace arthro::app
