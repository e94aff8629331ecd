// The attempt that runs: steps, lens and instrument, force, and what the trainee may do.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/options_panel.h"
#include "app/state/clock_words.h"
#include "app/steps/lessons/attempt.h"
#include "app/steps/lessons/pages/lesson_picture.h"
#include "app/steps/lessons/running_attempt.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using simulation::StripState;

constexpr float kStepPicture = 140;  // px at scale 1
constexpr float kActRow = 40;        // px at scale 1, height of the buttons

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

// Steps under way: of a free order all that are left.
void OpenSteps(Ui& ui, EditorState& state, const simulation::StepEngine& engine,
               const LessonTexture& texture_of) {
  const StripState& strip = engine.strip();
  const auto& steps = engine.exercise().steps;
  if (strip.open.empty()) return Text(ui, "Free practice: end the attempt when you are ready.");
  const bool is_one = strip.open.size() == 1;
  if (!is_one) QuietText(ui, "To do, in any order");
  for (const simulation::OpenStep& open : strip.open) {
    const ExerciseStep& step = steps[static_cast<std::size_t>(open.step)];
    const std::string& text = BaseOf(step).text;
    const std::string words = text.empty() ? WordsOfField(KindOf(step)) : text;
    if (is_one)
      Heading(ui, words);
    else
      Text(ui, words);
    if (is_one || open.progress > 0)
      MarkedBar(ui, is_one ? "Progress" : fmt::format("Progress##{}", open.step), open.progress,
                kGood, 0, fmt::format("{:.0f} %", 100 * open.progress));
    if (is_one) ShowLessonPicture(ui, state, BaseOf(step).picture, kStepPicture, texture_of);
  }
  if (strip.step_time_left)
    QuietText(ui, fmt::format("{:.0f} s left", std::ceil(*strip.step_time_left)));
}

// Buttons side by side of equal width, the one in use lit.
void ToggleRow(Ui& ui, EditorState& state, const std::vector<CommandState>& row) {
  const float gap = ui.Px(6), count = static_cast<float>(row.size());
  const float width = (ImGui::GetContentRegionAvail().x - (count - 1) * gap) / count;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    CommandToggle(ui, state, row[i].id, row[i].is_on, {width, ui.Px(kActRow)});
  }
}

void OfferedAngles(Ui& ui, EditorState& state) {
  const simulation::Practice& practice = *state.practice;
  struct Angle {
    const char* id;
    double degrees;
  };
  std::vector<CommandState> row;
  for (const auto& [id, degrees] :
       {Angle{"view-0", 0}, {"view-30", 30}, {"view-70", 70}, {"view-90", 90}}) {
    const double angle = RadiansFromDegrees(degrees);
    if (practice.OffersAngle(angle))
      row.push_back({id, std::abs(practice.view_angle() - angle) < 1e-6});
  }
  QuietText(ui,
            fmt::format("Scope: {:.0f}° view angle", DegreesFromRadians(practice.view_angle())));
  if (row.size() > 1) ToggleRow(ui, state, row);
}

void OfferedTools(Ui& ui, EditorState& state) {
  const simulation::Practice& practice = *state.practice;
  using simulation::ToolKind;
  struct Choice {
    const char* id;
    ToolKind kind;
  };
  std::vector<CommandState> row;
  for (const auto& [id, kind] : {Choice{"instrument-probe", ToolKind::kProbe},
                                 {"instrument-punch", ToolKind::kPunch},
                                 {"instrument-shaver", ToolKind::kShaver},
                                 {"instrument-grasper", ToolKind::kGrasper}})
    if (practice.Offers(kind)) row.push_back({id, practice.instrument_kind() == kind});
  QuietText(ui, practice.instrument_kind() == ToolKind::kProbe
                    ? "Instrument"
                    : "Instrument (C closes or runs it)");
  ToggleRow(ui, state, row);
}

// The exercise needs an instrument, or leaves the choice.
bool UsesInstruments(const Exercise& exercise) {
  return !exercise.setup.instruments.empty() || exercise.steps.empty() ||
         std::ranges::any_of(exercise.steps, simulation::UsesInstrument);
}

// A remark of the instructor, which becomes an event of the attempt.
void NoteField(Ui& ui, EditorState& state) {
  LessonsStep& lessons = *state.steps.lessons;
  const float button = ui.Px(90);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ui.Px(6));
  TextInput(ui, "Remark", lessons.note, "Remark of the instructor");
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "attempt-note", {button, 0});
}

}  // namespace

void AttemptPage(Ui& ui, EditorState& state, const LessonTexture& texture_of) {
  const simulation::StepEngine& engine = state.steps.lessons->running->engine;
  const StripState& strip = engine.strip();
  const Exercise& exercise = engine.exercise();
  // The commands stay in sight below the steps.
  const float foot = 3 * ui.Px(kActRow + 6) + ui.Px(kActRow);
  ImGui::BeginChild("steps", {0, std::max(ui.Px(80), ImGui::GetContentRegionAvail().y - foot)});
  Heading(ui, exercise.title);
  QuietText(ui, IsPaused(state) ? "Time, paused" : "Time");
  LargeText(ui, ClockWords(strip.time), IsPaused(state) ? kWarning : kBright);
  QuietText(ui, fmt::format("{} of {} steps done", strip.done, exercise.steps.size()));
  OpenSteps(ui, state, engine, texture_of);
  ForceBand(ui, strip);
  if (strip.step >= 0) Answers(ui, state, exercise.steps[static_cast<std::size_t>(strip.step)]);
  Gap(ui);
  if (!strip.force_band) QuietText(ui, fmt::format("Force on the tip {:.2f} N", strip.force));
  Gap(ui);
  OfferedAngles(ui, state);
  if (UsesInstruments(exercise)) OfferedTools(ui, state);
  ImGui::EndChild();
  NoteField(ui, state);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  CommandButton(ui, state, "attempt-hint", {half, ui.Px(kActRow)});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "attempt-mark", {half, ui.Px(kActRow)});
  CommandToggle(ui, state, "attempt-pause", IsPaused(state), {half, ui.Px(kActRow)});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "reset-tissues", {half, ui.Px(kActRow)});
  CommandButton(ui, state, "end-attempt", {-FLT_MIN, ui.Px(kActRow)});
}

}  // namespace arthro::app
