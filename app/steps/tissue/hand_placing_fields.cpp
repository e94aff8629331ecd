// Steps, mirror, fit and laying on the Place page.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/widgets.h"
#include "app/state/command.h"
#include "app/steps/tissue/hand_placing.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {

void FitFields(Ui& ui, EditorState& state) {
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "fit-to-relief", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  const Command& lay = CommandOf(state, "lay-on-relief");
  if (ToggleButton(ui, lay.words, LaysOnRelief(state), lay.enabled(state), {half, 0}, lay.help))
    Run(state, lay);
  if (LaysOnRelief(state) && state.dialogs.empty() && !ImGui::GetIO().WantTextInput &&
      ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    ToggleLaying(state);
  const authoring::ReliefFit& fit = FitOfChosen(state);
  QuietText(ui, FitWords(fit));
  if (const std::string words = IntersectionWords(fit); !words.empty())
    ColouredText(ui, words, kWarning);
  Checkbox(ui, "Only its outline", state.steps.tissue->placing.shows_outline,
           "The tissue is an outline in the scope's picture: compare it with what lies below.");
}

void StepFields(Ui& ui, EditorState& state) {
  HandPlacing& placing = state.steps.tissue->placing;
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  QuietText(ui, "Steps of Ctrl+arrows and Ctrl+page keys");
  ImGui::SetNextItemWidth(half);
  double mm = MmFromMetres(placing.step), degrees = DegreesFromRadians(placing.turn);
  if (NumberField(
          ui, "Step", mm, 0.05, 0.05, 20, "%.2f mm",
          "Ctrl+arrows move the tissue right, left, up and down, Ctrl+page keys in and out."))
    placing.step = MetresFromMm(mm);
  ImGui::SameLine(0, ui.Px(8));
  ImGui::SetNextItemWidth(half);
  if (NumberField(ui, "Turn", degrees, 0.1, 0.1, 90, "%.1f°",
                  "Ctrl+Shift with the same keys turns it about its middle."))
    placing.turn = RadiansFromDegrees(degrees);
  bool own_axes = placing.axes == authoring::NudgeAxes::kTissue;
  if (Checkbox(ui, "Along its own axes", own_axes,
               "Otherwise along right, down and in, as the fields above."))
    placing.axes = own_axes ? authoring::NudgeAxes::kTissue : authoring::NudgeAxes::kPortal;
  CommandButton(ui, state, "mirror-tissue", {-FLT_MIN, 0});
}

}  // namespace arthro::app
