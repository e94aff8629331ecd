// Steps, mirror, fit and laying on the Place page.
#include <cmath>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/widgets.h"
#include "app/state/command.h"
#include "app/steps/tissue/hand_placing.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/distance_colours.h"
#include "simulation/core/units.h"

namespace arthro::app {

namespace {

// Bar of the colours of distances, with its ends and its middle in words.
void DistanceLegend(Ui& ui) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.Px(12);
  constexpr int kParts = 48;
  for (int i = 0; i < kParts; ++i) {
    const double share = (i + 0.5) / kParts;
    const glm::dvec3 colour = authoring::ColourOfDistance((2 * share - 1) * authoring::kFullColour);
    ImGui::GetWindowDrawList()->AddRectFilled(
        {at.x + width * static_cast<float>(i) / kParts, at.y},
        {at.x + width * static_cast<float>(i + 1) / kParts, at.y + height},
        ImGui::GetColorU32({static_cast<float>(colour.r), static_cast<float>(colour.g),
                            static_cast<float>(colour.b), 1.0f}));
  }
  ImGui::Dummy({width, height});
  const std::string most = fmt::format("{:.0f} mm", MmFromMetres(authoring::kFullColour));
  const std::string left = most + " behind", right = most + " before";
  QuietText(ui, left);
  ImGui::SameLine(0.5f * (width - ui.WidthOf("on it")));
  QuietText(ui, "on it");
  ImGui::SameLine(width - ui.WidthOf(right));
  QuietText(ui, right);
}

// Short lines in the colours of the contours, with their distances in words.
void ContourLegend(Ui& ui) {
  const auto line = [&](double level) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ui.Px(22), height = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddLine({at.x, at.y + height / 2},
                                        {at.x + width, at.y + height / 2}, ColourOfContour(level),
                                        ui.Px(level == 0 ? 3 : 2));
    ImGui::Dummy({width, height});
    ImGui::SameLine(0, ui.Px(4));
    QuietText(ui, fmt::format("{:g}", MmFromMetres(std::abs(level))));
  };
  for (const bool is_behind : {false, true}) {
    for (const double level : authoring::kContourLevels) {
      const double shown = is_behind ? -level : level;
      if (level < 0 || (is_behind && level == 0)) continue;
      line(shown);
      ImGui::SameLine(0, ui.Px(8));
    }
    QuietText(ui, is_behind ? "mm behind it" : "mm before it");
  }
}

// Part of the surface that the fit takes.
void PatchFields(Ui& ui, EditorState& state) {
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandToggle(ui, state, "pick-patch", PicksPatch(state), {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "remove-patch", {half, 0});
  if (PicksPatch(state) && state.dialogs.empty() && !ImGui::GetIO().WantTextInput &&
      ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    TogglePatch(state);
  HandPlacing& placing = state.steps.tissue->placing;
  if (!PicksPatch(state) && !PatchOf(state)) return;
  double mm = MmFromMetres(placing.patch_radius);
  if (!Slider(ui, "Radius of the part", mm, 1.0, 30.0, "%.1f mm")) return;
  placing.patch_radius = MetresFromMm(mm);
  if (PatchOf(state))
    placing.patch->radius =
        placing.patch_radius /
        state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].pose.scale;
}

}  // namespace

void FitFields(Ui& ui, EditorState& state) {
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "fit-to-relief", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandToggle(ui, state, "lay-on-relief", LaysOnRelief(state), {half, 0});
  if (LaysOnRelief(state) && state.dialogs.empty() && !ImGui::GetIO().WantTextInput &&
      ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    ToggleLaying(state);
  PatchFields(ui, state);
  const authoring::ReliefFit& fit = FitOfChosen(state);
  QuietText(ui, FitWords(fit));
  if (const std::string words = IntersectionWords(fit); !words.empty())
    ColouredText(ui, words, kWarning);
  HandPlacing& placing = state.steps.tissue->placing;
  Checkbox(ui, "Distances in colour", placing.shows_distances,
           "Colour the tissue in the overview by its distance from the relief.");
  if (placing.shows_distances) DistanceLegend(ui);
  Checkbox(ui, "Distances as lines", placing.shows_contours,
           "Draw lines of equal distance from the relief on the tissue, in the scope's picture and "
           "the panorama.");
  if (placing.shows_contours) ContourLegend(ui);
  Checkbox(ui, "Only its outline", placing.shows_outline,
           "The tissue is an outline in the scope's picture: compare it with what lies below.");
  double faded = 100 * placing.fade;
  if (Slider(ui, "Fade", faded, 0, 100, "%.0f %%",
             "Fade the tissue out of the scope's picture, to compare it with what lies below."))
    placing.fade = 0.01 * faded;
  CommandToggle(ui, state, "show-before", ShownBefore(state).has_value(), {-FLT_MIN, 0});
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
  Checkbox(ui, "Snap to the steps", placing.snaps,
           "Drags along the arms and about the rings of the handle go by whole steps.");
  bool own_axes = placing.axes == authoring::NudgeAxes::kTissue;
  if (Checkbox(ui, "Along its own axes", own_axes,
               "Otherwise along right, down and in, as the fields above."))
    placing.axes = own_axes ? authoring::NudgeAxes::kTissue : authoring::NudgeAxes::kPortal;
  if (!ImportedTogether(state, state.tissue).empty())
    Checkbox(ui, "Move what was imported with it", state.steps.tissue->imports->moves_together,
             "Surfaces that keep their places to one another are moved, turned and scaled as one.");
  CommandButton(ui, state, "mirror-tissue", {-FLT_MIN, 0});
}

}  // namespace arthro::app
