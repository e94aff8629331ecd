// Disturbances of the picture of a practice, each with its strength.
#include <string>

#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {

void DisturbancesPage(Ui& ui, EditorState& state, const Area& area) {
  const FixedWindow window(ui, "disturbances", area, kPageWindow);
  SessionStrip(ui, state);
  Heading(ui, "Disturbances");
  QuietText(ui, "Difficulties for the trainee. They change the picture, not the forces.");
  Gap(ui);
  const float button = ui.Px(118), high = ui.Px(40);
  for (const auto& [id, strength] : DisturbanceSwitches()) {
    const Command& command = CommandOf(state, id);
    const bool is_on = state.steps.practice->disturbing.now.*strength > 0;
    if (ToggleButton(ui, command.words, is_on, true, {button, high}, command.help))
      Run(state, command);
    ImGui::SameLine(0, ui.Px(8));
    ImGui::BeginGroup();
    double value = state.steps.practice->disturbing.chosen.*strength;
    if (Slider(ui, std::string(command.words) + " strength", value, kLeastStrength, 1.0, "%.2f",
               "How strong it is; 1 is the strongest."))
      SetDisturbance(state, strength, value);
    ImGui::EndGroup();
  }
  Gap(ui);
  CommandButton(ui, state, "clear-view", {-FLT_MIN, ui.Px(44)});
  if (Button(ui, "Hide disturbances", true, {-FLT_MIN, ui.Px(44)})) Run(state, "disturbances");
}

}  // namespace arthro::app
