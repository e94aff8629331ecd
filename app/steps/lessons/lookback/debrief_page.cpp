// The look back at an attempt: events beside the picture; steps, force, centring and path over
// time. A click into a figure or on an event goes there.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/plot.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/lessons/value_words.h"
#include "simulation/core/units.h"
#include "simulation/device/device_sample.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/steps/same_moment.h"
#include "simulation/training/steps/step_words.h"

namespace arthro::app {
namespace {

using simulation::AttemptEvent;
using simulation::AttemptFrame;
using simulation::DeviceRole;
using simulation::EventKind;

constexpr std::size_t kMostPoints = 2000;  // points in a curve; more than a figure has pixels

// Largest of each run of frames, so that a short peak is not lost; NaN where none has a value.
template <class ValueOf>
PlotCurve CurveOf(const std::vector<AttemptFrame>& frames, const ValueOf& value_of) {
  PlotCurve curve;
  const std::size_t run = std::max<std::size_t>(1, frames.size() / kMostPoints);
  for (std::size_t first = 0; first < frames.size(); first += run) {
    float most = kNoValue;
    for (std::size_t i = first; i < std::min(first + run, frames.size()); ++i) {
      const float value = value_of(frames[i]);
      if (std::isfinite(value) && !(most >= value)) most = value;
    }
    curve.points.push_back(
        {static_cast<float>(simulation::kFrameTime * static_cast<double>(first)), most});
  }
  return curve;
}

float PeakForce(const AttemptFrame& frame, DeviceRole role) {
  const simulation::ToolFrame& tool = frame.tool[static_cast<std::size_t>(role)];
  return tool.is_valid ? tool.peak_force : kNoValue;
}

Plot OverTime(const FinishedAttempt& attempt, const Debrief& debrief, const char* title) {
  Plot plot;
  plot.title = title;
  plot.right = simulation::kFrameTime * static_cast<double>(attempt.frames.size());
  plot.x_unit = " s";
  plot.cursor = debrief.at;
  for (const AttemptEvent& event : attempt.result.events)
    if (event.kind == EventKind::kStepDone || event.kind == EventKind::kStepFailed)
      plot.marks.push_back({event.t, event.kind == EventKind::kStepDone ? kGood : kBad});
  return plot;
}

Plot ForcePlot(const FinishedAttempt& attempt, const Debrief& debrief) {
  Plot plot = OverTime(attempt, debrief, "Force on the tips, N: scope grey, instrument blue");
  for (const DeviceRole role : {DeviceRole::kScope, DeviceRole::kInstrument}) {
    plot.curves.push_back(
        CurveOf(attempt.frames, [&](const AttemptFrame& frame) { return PeakForce(frame, role); }));
    plot.curves.back().colour = role == DeviceRole::kScope ? kQuiet : kAccent;
  }
  for (const Criterion& criterion : attempt.exercise.criteria)
    if (criterion.metric == "peak_force" && criterion.max) plot.limits.push_back(*criterion.max);
  FitAxes(plot);
  return plot;
}

// Nearest target to the middle of the picture.
Plot CentrePlot(const FinishedAttempt& attempt, const Debrief& debrief) {
  Plot plot = OverTime(attempt, debrief, "Nearest target from the centre (1: rim)");
  plot.curves.push_back(CurveOf(attempt.frames, [](const AttemptFrame& frame) {
    float nearest = kNoValue;
    for (int i = 0; i < frame.sight.targets; ++i) {
      const auto& sight = frame.sight.target[static_cast<std::size_t>(i)];
      if (sight.is_clear && !(nearest <= sight.centre)) nearest = sight.centre;
    }
    return nearest;
  }));
  return plot;
}

// Ways of both tips, from the front: right and up, mm.
Plot PathPlot(const FinishedAttempt& attempt, const AttemptFrame* now) {
  Plot plot;
  plot.title = "Paths of both tips from the front, mm";
  plot.is_equal = true;
  plot.left = plot.low = std::numeric_limits<double>::max();
  plot.right = plot.high = std::numeric_limits<double>::lowest();
  const auto point = [](const simulation::ToolFrame& tool) {
    return tool.is_inside() ? ImVec2{1e3F * tool.tip.x, -1e3F * tool.tip.y} : ImVec2{0, kNoValue};
  };
  const std::size_t run = std::max<std::size_t>(1, attempt.frames.size() / kMostPoints);
  for (const DeviceRole role : {DeviceRole::kScope, DeviceRole::kInstrument}) {
    PlotCurve curve;
    curve.colour = role == DeviceRole::kScope ? kQuiet : kAccent;
    for (std::size_t i = 0; i < attempt.frames.size(); i += run)
      curve.points.push_back(point(attempt.frames[i].tool[static_cast<std::size_t>(role)]));
    plot.curves.push_back(std::move(curve));
    if (now != nullptr)
      plot.curves.push_back({{point(now->tool[static_cast<std::size_t>(role)])}, kBright, true});
  }
  FitAxes(plot);
  return plot;
}

// Two plots over time and one of paths: below each other, the last twice as high, or side by side
// in a low area.
std::array<Area, 3> PlotAreas(const Area& area, float gap) {
  if (area.width > 2 * area.height) {
    const float width = (area.width - 4 * gap) / 3;
    const auto at = [&](float column) {
      return Area{area.x + gap + column * (width + gap), area.y + gap, width,
                  area.height - 2 * gap};
    };
    return {at(0), at(1), at(2)};
  }
  const float height = (area.height - 4 * gap) / 4;
  const auto at = [&](float row, float rows) {
    return Area{area.x + gap, area.y + gap + row * (height + gap), area.width - 2 * gap,
                rows * height};
  };
  return {at(0, 1), at(1, 1), at(2, 2)};
}

// Steps as blocks over the time of the attempt, each with its number, and green or red at its end;
// a click goes to its begin. Steps of a free order stand one after the other as they were done.
void StepBar(Ui& ui, const FinishedAttempt& attempt, Debrief& debrief, const Area& area) {
  const double whole =
      std::max(0.01, simulation::kFrameTime * static_cast<double>(attempt.frames.size()));
  const auto at = [&](double t) {
    return area.x + area.width * static_cast<float>(std::clamp(t / whole, 0.0, 1.0));
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height},
                      ImGui::GetColorU32(ImGuiCol_FrameBg), ui.Px(4));
  const auto& steps = attempt.result.steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const simulation::StepResult& step = steps[i];
    if (step.outcome == simulation::StepOutcome::kPending) continue;
    const bool is_done = step.outcome == simulation::StepOutcome::kDone,
               is_failed = step.outcome == simulation::StepOutcome::kFailed;
    // A step of a free order that was never done would lie under all the others.
    if (!is_done && attempt.exercise.order == StepOrder::kFree) continue;
    const simulation::StepTime time = simulation::TimeOf(steps, step);
    const float left = at(time.begin), right = at(step.ended ? time.end : whole);
    const unsigned colour = is_done ? kGood : is_failed ? kBad : kQuiet;
    draw->AddRectFilled({left + 1, area.y + 1},
                        {std::max(right, left + ui.Px(3)) - 1, area.y + area.height - 1},
                        (colour & 0x00FFFFFF) | 0x60000000, ui.Px(3));
    const std::string words = is_failed ? fmt::format("{} ×", i + 1) : fmt::format("{}", i + 1);
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    if (size.x + ui.Px(4) <= right - left)
      draw->AddText({0.5F * (left + right - size.x), area.y + 0.5F * (area.height - size.y)},
                    OnGround(kBright), words.c_str());
    ImGui::SetCursorScreenPos({left, area.y});
    if (HitArea(fmt::format("step {}", i + 1).c_str(),
                {std::max(right - left, ui.Px(3)), area.height}))
      debrief.at = time.begin, debrief.plays = false;
    RecordItem(ui, fmt::format("Step {}", i + 1));
    if (ImGui::IsItemHovered()) {
      const int index = simulation::StepIndex(attempt.exercise, step.id);
      if (index >= 0)
        Tooltip(
            ui,
            simulation::StepTitle(attempt.exercise.steps[static_cast<std::size_t>(index)]).c_str());
    }
  }
  const float now = at(debrief.at);
  draw->AddLine({now, area.y - ui.Px(2)}, {now, area.y + area.height + ui.Px(2)}, OnGround(kBright),
                ui.Px(2));
}

bool IsOfStep(EventKind kind) {
  return kind == EventKind::kStepStart || kind == EventKind::kStepDone ||
         kind == EventKind::kStepFailed;
}

// "2. Touch the spine"
std::string StepLine(const Exercise& exercise, const std::string& id) {
  const int index = simulation::StepIndex(exercise, id);
  if (index < 0) return id;
  return fmt::format("{}. {}", index + 1,
                     simulation::StepTitle(exercise.steps[static_cast<std::size_t>(index)]));
}

void Events(Ui& ui, LessonsStep& step, const FinishedAttempt& attempt) {
  int number = 0;
  for (const AttemptEvent& event : attempt.result.events) {
    std::string words = fmt::format("{:.1f} s  {}", event.t, EventWords(event.kind));
    if (!event.target.empty()) words += " " + event.target;
    if (IsOfStep(event.kind)) words += ": " + StepLine(attempt.exercise, event.step);
    const bool is_now = std::abs(step.debrief.at - event.t) < 0.5;
    if (ListEntry(ui, words + "##" + std::to_string(number++), is_now)) step.debrief.at = event.t;
  }
}

}  // namespace

void Notices(Ui& ui, const FinishedAttempt& attempt) {
  for (std::size_t begin = 0; begin < attempt.notice.size();) {
    const std::size_t end = std::min(attempt.notice.find('\n', begin), attempt.notice.size());
    ColouredText(ui, attempt.notice.substr(begin, end - begin), kWarning);
    begin = end + 1;
  }
}

void DebriefSide(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "debrief", area, kPageWindow);
  LessonsStep& step = *state.steps.lessons;
  const FinishedAttempt& attempt = *step.finished;
  Heading(ui, attempt.exercise.title);
  double seconds = step.debrief.at;
  const double end = simulation::kFrameTime * static_cast<double>(attempt.frames.size());
  if (Slider(ui, "Time", seconds, 0, std::max(end, 0.01), "%.2f s")) step.debrief.at = seconds;
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  if (ToggleButton(ui, "Play", step.debrief.plays, true, {half, ui.Px(40)})) {
    step.debrief.plays = !step.debrief.plays;
    if (step.debrief.at >= end) step.debrief.at = 0;
  }
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "attempt-summary", {half, ui.Px(40)});
  Slider(ui, "Speed", step.debrief.speed, 0.25, 4, "%.2f");
  Notices(ui, attempt);
  if (!step.debrief.expert) QuietText(ui, step.debrief.expert_words);
  Gap(ui);
  const bool rates = ShowsRating(state);
  Heading(ui, rates ? "Rating" : "Events");
  const float foot = ui.Px(54);
  ImGui::BeginChild(rates ? "rating" : "events",
                    {0, std::max(ui.Px(80), ImGui::GetContentRegionAvail().y - foot)});
  if (rates)
    RatingFields(ui, state);
  else
    Events(ui, step, attempt);
  ImGui::EndChild();
  CommandButton(ui, state, "rate-attempt", {half, ui.Px(44)});
  ImGui::SameLine(0, ui.Px(6));
  CommandButton(ui, state, "close-lesson", {half, ui.Px(44)});
}

void DebriefPlots(Ui& ui, EditorState& state, const Area& area) {
  // Plots fill the window up to its edges: it has no padding, and so nothing to scroll.
  const FixedWindow window(ui, "debrief plots", area, kPictureWindow);
  LessonsStep& step = *state.steps.lessons;
  const FinishedAttempt& attempt = *step.finished;
  const float bar = ui.Px(26), gap = ui.Px(8);
  StepBar(ui, attempt, step.debrief, {area.x + gap, area.y + gap, area.width - 2 * gap, bar});
  const std::array<Area, 3> areas =
      PlotAreas({area.x, area.y + bar + gap, area.width, area.height - bar - gap}, gap);
  for (const auto& picked : {DrawPlot(ui, ForcePlot(attempt, step.debrief), areas[0]),
                             DrawPlot(ui, CentrePlot(attempt, step.debrief), areas[1])})
    if (picked) step.debrief.at = *picked, step.debrief.plays = false;
  DrawPlot(ui, PathPlot(attempt, DebriefFrame(state)), areas[2]);
}

}  // namespace arthro::app
