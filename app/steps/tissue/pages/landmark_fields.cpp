// The list of landmarks on the Place page: residuals, warnings and the buttons.
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/widgets.h"
#include "app/state/command.h"
#include "app/steps/tissue/landmark_mode.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

std::string RowOf(const LandmarkMode& mode, std::size_t i) {
  if (mode.pairs[i].is_left_out) return fmt::format("{}   left out", i + 1);
  if (!mode.alignment.is_aligned()) return fmt::format("{}", i + 1);
  const authoring::LandmarkResidual& residual = mode.alignment.residuals[i];
  std::string row = fmt::format("{}   {:.2f} mm", i + 1, MmFromMetres(residual.distance));
  if (residual.px) row += fmt::format("   {:.1f} px", *residual.px);
  if (residual.is_wrong) row += "   wrong?";
  return row;
}

void Rows(Ui& ui, EditorState& state) {
  for (std::size_t i = 0; i < state.steps.tissue->landmarks.pairs.size(); ++i) {
    const LandmarkMode& mode = state.steps.tissue->landmarks;
    const int number = static_cast<int>(i);
    const bool is_wrong =
        i < mode.alignment.residuals.size() && mode.alignment.residuals[i].is_wrong;
    ImGui::PushID(number);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.Px(2), ui.Px(1)});
    bool is_used = !mode.pairs[i].is_left_out;
    if (Checkbox(ui, fmt::format("##use landmark {}", i + 1), is_used, "Whether it takes part."))
      LeaveOutLandmark(state, number, !is_used);
    ImGui::PopStyleVar();
    ImGui::SameLine(0, ui.Px(6));
    if (is_wrong) ImGui::PushStyleColor(ImGuiCol_Text, kWarning);
    if (ImGui::Selectable(ui.translation.Label(RowOf(mode, i)).c_str(), mode.chosen == number))
      ChooseLandmark(state, number);
    if (is_wrong) ImGui::PopStyleColor();
    RecordItem(ui, fmt::format("Landmark {}", i + 1), true, RowOf(mode, i));
    ImGui::PopID();
  }
}

void Result(Ui& ui, const LandmarkMode& mode) {
  const authoring::LandmarkAlignment& alignment = mode.alignment;
  if (!alignment.is_aligned())
    ColouredText(ui, alignment.sentence,
                 alignment.verdict == authoring::AlignVerdict::kTooFew ? kQuiet : kBad);
  else
    QuietText(
        ui,
        fmt::format("Expected error: {:.2f} mm, {:.1f}°{}", MmFromMetres(alignment.position_sigma),
                    DegreesFromRadians(alignment.rotation_sigma),
                    mode.solves_scale
                        ? fmt::format(", scale {:.3f} ± {:.3f}", alignment.portal_from_tissue.scale,
                                      alignment.portal_from_tissue.scale * alignment.scale_sigma)
                        : ""));
  for (const std::string& warning : alignment.warnings) ColouredText(ui, warning, kWarning);
}

}  // namespace

void LandmarkFields(Ui& ui, EditorState& state) {
  CommandToggle(ui, state, "landmarks", PlacesLandmarks(state), {-FLT_MIN, 0});
  if (PlacesLandmarks(state) && state.dialogs.empty() && !ImGui::GetIO().WantTextInput &&
      ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    LeaveLandmarks(state);
  if (!PlacesLandmarks(state)) return;
  KeepLandmarksFresh(state);
  ColouredText(ui, LandmarkPrompt(state), kAccent);
  CommandButton(ui, state, "align-landmarks", {-FLT_MIN, ui.Px(32)});
  Rows(ui, state);
  Result(ui, state.steps.tissue->landmarks);
  CommandRow(ui, state, {{"remove-landmark"}, {"remove-all-landmarks"}});
  bool solves_scale = state.steps.tissue->landmarks.solves_scale;
  if (Checkbox(ui, "Solve for the scale", solves_scale,
               "Needed where the model has another size than the patient's tissue."))
    SolveForScale(state, solves_scale);
  Checkbox(ui, "Only its outline", state.steps.tissue->landmarks.shows_outline,
           "The tissue is an outline in the scope's picture, so that it hides nothing.");
  Gap(ui);
}

}  // namespace arthro::app
