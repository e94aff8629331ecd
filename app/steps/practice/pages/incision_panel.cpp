// Beside the picture while a hand's incision is calibrated: what to do, how well it is known by
// now, and whether that may be used.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/steps/practice/practice_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using simulation::PivotCalibration;
using simulation::PivotSource;
using simulation::PivotStatus;

constexpr double kEnough = 30 * kRadianPerDegree;  // [method.md, Pivot calibration]
constexpr double kFullBar = 60 * kRadianPerDegree;

std::string InMm(double metres) {
  return std::isfinite(metres) ? fmt::format("{:.3g} mm", MmFromMetres(metres)) : std::string("–");
}

std::string Capital(std::string sentence) {
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z') sentence[0] -= 'a' - 'A';
  if (!sentence.empty() && sentence.back() != '.') sentence += '.';
  return sentence;
}

// Name on the left, number on the right.
void Number(Ui& ui, const std::string& name, const std::string& value) {
  QuietText(ui, name);
  ImGui::SameLine(ui.Px(150));
  Text(ui, value);
  RecordItem(ui, name, true, value);
}

void HowWellKnown(Ui& ui, const simulation::PivotWork& work) {
  const PivotCalibration& found = work.found();
  const bool is_swing = work.source() == PivotSource::kSwing;
  QuietText(ui, is_swing || work.poses().empty() ? "Angle between the rods"
                                                 : "Angle to the furthest press");
  LargeText(ui, fmt::format("{:.0f}°", DegreesFromRadians(work.angle())),
            work.angle() < kEnough ? kBright : kGood);
  MarkedBar(ui, "Angle bar", work.angle() / kFullBar, work.angle() < kEnough ? kWarning : kGood,
            kEnough / kFullBar, fmt::format("{:.0f}°", DegreesFromRadians(work.angle())));
  QuietText(ui, "30° or more (mark)");
  Gap(ui);
  const bool is_solved = found.status != PivotStatus::kTooFew;
  Number(ui, "Predicted error", is_solved ? InMm(found.sigma) : "–");
  Number(ui, "Residual", is_solved ? InMm(found.residual) : "–");
  Number(ui, is_swing ? "Poses" : "Presses",
         found.left_out.empty()
             ? fmt::format("{}", work.poses().size())
             : fmt::format("{}, {} left out", work.poses().size(), found.left_out.size()));
}

void WhatOfIt(Ui& ui, const simulation::PivotWork& work) {
  const PivotCalibration& found = work.found();
  if (const auto done = work.pressing()) {
    Text(ui, fmt::format("Hold still… {:.0f} %", 100 * *done));
  } else if (!work.refusal().empty()) {
    ColouredText(ui, Capital(work.refusal()), kWarning);
  } else if (found.status == PivotStatus::kOk) {
    ColouredText(ui, "This incision can be used.", kGood);
    if (!found.reason.empty()) QuietText(ui, Capital(found.reason));
  } else {
    ColouredText(ui, Capital(found.reason),
                 found.status == PivotStatus::kTooFew ? kBright : kWarning);
  }
}

void Ways(Ui& ui, simulation::PivotWork& work) {
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  const bool is_swing = work.source() == PivotSource::kSwing;
  if (ToggleButton(ui, "Two presses", !is_swing, true, {half, ui.Px(36)},
                   "Press at two or more places; hold the rod still at each.") &&
      is_swing)
    work.Begin(PivotSource::kPresses);
  ImGui::SameLine(0, ui.Px(8));
  if (ToggleButton(ui, "Keep swinging", is_swing, true, {half, ui.Px(36)},
                   "Up to 2000 poses of a moving hand; poses that slip are left out.") &&
      !is_swing)
    work.Begin(PivotSource::kSwing);
  Text(ui, is_swing ? "Hold the rod through the incision and swing it by 30° or more in "
                      "every direction."
                    : "Hold the rod through the incision and press its handle's button, or B. "
                      "Tilt it by 30° or more and press again.");
}

}  // namespace

void IncisionPage(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "incision", area, kPageWindow);
  PivotCalibrating& own = *state.steps.practice->calibrating;
  const simulation::HandNow hand = state.steps.practice->hands->Now(own.role);
  const bool is_scope = own.role == simulation::DeviceRole::kScope;
  Heading(ui, is_scope ? "Incision of the scope" : "Incision of the instrument");
  QuietText(ui, hand.sentence.empty() ? hand.name : hand.name + ": " + hand.sentence);
  Gap(ui, 2);
  Ways(ui, own.work);
  Gap(ui);
  HowWellKnown(ui, own.work);
  Gap(ui);
  WhatOfIt(ui, own.work);
  Gap(ui);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  if (own.work.source() == PivotSource::kPresses) {
    CommandButton(ui, state, "press-incision", {half, ui.Px(kThumbButton)});
    ImGui::SameLine(0, ui.Px(8));
  }
  CommandButton(ui, state, "begin-incision-again", {half, ui.Px(kThumbButton)});
  // Allows a solved pivot when only the rod's length is in doubt: the pivot is right, and a person
  // who calibrates with the rod drawn back would otherwise be stopped.
  if (own.work.found().status == PivotStatus::kOutsideRod)
    QuietText(ui,
              "The pivot itself is known; only the rod's length, or where its tip was, is in "
              "doubt. It may be used all the same.");
  CommandButton(ui, state, "use-incision", {-FLT_MIN, ui.Px(kThumbButton)});
  if (!own.outcome.empty()) {
    ColouredText(ui, own.outcome, own.is_unsaved ? kWarning : kGood);
    if (state.steps.practice->hands->IsInRig(own.role))
      CommandButton(ui, state, "save-rig-as", {-FLT_MIN, ui.Px(36)});
  }
  Gap(ui);
  double noise_deg = DegreesFromRadians(own.work.options().angle_noise);
  if (Slider(ui, "Noise of the handle's angles", noise_deg, 0.0, 5.0, "%.2f°",
             "As the maker states it, rms: about 0.1 for encoders, 0.5 to 2 for potentiometers."))
    own.work.SetAngleNoise(RadiansFromDegrees(noise_deg));
  QuietText(ui, "No device gets a force during calibration.");
  CommandButton(ui, state, "close-calibration", {-FLT_MIN, ui.Px(kThumbButton)});
}

}  // namespace arthro::app
