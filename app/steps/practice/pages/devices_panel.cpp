// Devices that hold the two hands, and their state: beside the practice, or in the last step.
#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {
namespace {

using simulation::DeviceRole;

constexpr double kFullMeter = 3.3;  // N, where a device says no peak of its own
constexpr float kPlotHeight = 34;
constexpr float kBetween = 8;  // px, gap between two buttons or plots

// Filled: what the device is given. The line: what the session has for the hand.
void ForceMeter(Ui& ui, const std::string& name, const simulation::HandNow& now) {
  const double full = now.peak > 0 ? now.peak : kFullMeter;
  MarkedBar(ui, name + " force meter", now.given / full, kGood, now.felt / full,
            fmt::format("{:.2f} N", now.given));
  QuietText(ui, fmt::format("{:.2f} N given of {:.2f} N shown; full scale {:.1f} N", now.given,
                            now.felt, full));
}

void Plot(Ui& ui, const std::string& name,
          const std::array<float, simulation::ForceHistory::kLength>& values, int oldest,
          float least_top, const char* unit, float width) {
  const float top = std::max(least_top, *std::max_element(values.begin(), values.end()));
  ImGui::PlotLines(("##" + name).c_str(), values.data(), simulation::ForceHistory::kLength, oldest,
                   nullptr, 0, top, {width, ui.Px(kPlotHeight)});
  RecordItem(ui, name);
  // Its scale, in its corner.
  const ImVec2 low = ImGui::GetItemRectMin();
  const std::string scale = fmt::format("{:.3g} {}", top, unit);
  ImGui::GetWindowDrawList()->AddText({low.x + ui.Px(6), low.y + ui.Px(2)}, kQuiet, scale.c_str());
}

float HalfWidth(const Ui& ui) { return (ImGui::GetContentRegionAvail().x - ui.Px(kBetween)) / 2; }

void HandPart(Ui& ui, EditorState& state, DeviceRole role, const char* name) {
  const simulation::Hands& hands = *state.steps.practice->hands;
  const simulation::HandNow now = hands.Now(role);
  Heading(ui, name);
  Text(ui, now.serial.empty() ? now.name : now.name + ", serial " + now.serial);
  if (!now.sentence.empty()) QuietText(ui, now.sentence);
  if (!now.last_fault.empty()) ColouredText(ui, "Last fault: " + now.last_fault, kWarning);
  if (now.kind != simulation::HandKind::kMouse) {
    ForceMeter(ui, name, now);
    const simulation::ForceHistory history = hands.History(role);
    QuietText(ui,
              fmt::format("Ten seconds of force and sample age ({:.1f} ms)", 1e3 * now.sample_age));
    const float half = HalfWidth(ui);
    Plot(ui, std::string(name) + " force plot", history.forces(), history.oldest(), 1.0f, "N",
         half);
    ImGui::SameLine(0, ui.Px(kBetween));
    Plot(ui, std::string(name) + " age plot", history.ages(), history.oldest(), 5.0f, "ms", half);
  }
  if (const char* why = simulation::WhyNoForce(now.situation); *why != '\0') {
    Text(ui, "Why is there no force?");
    ColouredText(ui, why, kAccent);
  }
  if (hands.KindOf(role) == simulation::HandKind::kMouse) return;
  if (const std::string why = hands.WhyNotCalibrated(role); !why.empty())
    QuietText(ui, why);
  else
    CommandButton(ui, state,
                  role == DeviceRole::kScope ? "calibrate-scope" : "calibrate-instrument",
                  {-FLT_MIN, ui.Px(40)});
}

}  // namespace

void DevicesPanel(Ui& ui, EditorState& state) {
  HandPart(ui, state, DeviceRole::kScope, "Scope");
  Gap(ui);
  HandPart(ui, state, DeviceRole::kInstrument, "Instrument");
  Gap(ui);
  if (state.practice && !state.practice->servo_sentence().empty())
    QuietText(ui, state.practice->servo_sentence());
  const Command& zero = CommandOf(state, "zero-force");
  if (ToggleButton(ui, zero.words, state.steps.practice->hands->is_zero_force(), true,
                   {-FLT_MIN, ui.Px(44)}, zero.help))
    Run(state, zero);
  QuietText(ui,
            "V, a handle's button or a pedal is the dead-man switch: devices push only while it is "
            "held.");
  Gap(ui, 2);
  const float half = HalfWidth(ui);
  CommandButton(ui, state, "validation-plot", {half, ui.Px(44)});
  ImGui::SameLine(0, ui.Px(kBetween));
  if (Button(ui, "Hide devices", true, {half, ui.Px(44)})) Run(state, "devices");
  if (state.practice) ForcePanel(ui, state);
  // In the editor the status bar says what was done.
  if (state.practice && !state.message.empty()) QuietText(ui, state.message);
}

void DevicesPage(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "devices", area, kPageWindow);
  SessionStrip(ui, state);
  DevicesPanel(ui, state);
}

}  // namespace arthro::app
