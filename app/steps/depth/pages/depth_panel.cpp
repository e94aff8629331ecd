// Step 2: how the panorama's brightness becomes relief.
#include <cfloat>
#include <string_view>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/panels/no_panorama.h"
#include "app/panels/options_panel.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "simulation/core/units.h"

namespace arthro::app {

namespace {

// Switch between the scene through the scope and the map.
void ScopeOrMap(Ui& ui, EditorState& state) {
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  const bool is_map = ShowsDepthBoard(state);
  CommandToggle(ui, state, "depth-scope", !is_map, {half, 0});
  ImGui::SameLine();
  CommandToggle(ui, state, "depth-map", is_map, {half, 0});
  Gap(ui, 2);
}

// Tool of a drag over the scope's picture and the overview.
void TouchOrBrush(Ui& ui, EditorState& state) {
  const float half = ColumnWidth(2);
  CommandToggle(ui, state, "touch-preview", TouchesRelief(state), {half, 0});
  ImGui::SameLine();
  const bool paints = PaintsDepth(state);
  const Command& brush = CommandOf(state, paints ? "leave-depth-brush" : "map-brush");
  const bool is_pressed = ToggleButton(ui, "Brush", paints, brush.enabled(state), {half, 0});
  CommandTip(ui, state, brush);
  if (is_pressed) Run(state, brush);
}

}  // namespace

void DepthPanel(Ui& ui, EditorState& state) {
  const authoring::Document document = state.document();  // a copy: edits below move it
  if (!document.panorama) return AskForPanorama(ui, state, "Depth is made from a panorama.");
  ScopeOrMap(ui, state);
  const bool is_imported = document.is_depth_imported;
  if (HasMeasuredDepth(document))
    Text(ui, "Measured from the motion of the scope.");
  else if (!is_imported)
    Text(ui, "Estimated from brightness, not measured.");
  if (ShowsDepthBoard(state)) {
    Gap(ui, 2);
    return DepthMapPanel(ui, state);
  }
  if (is_imported) {
    if (!HasMeasuredDepth(document))
      Text(ui, "This scene has a depth map that was imported, not made from its picture.");
    QuietText(ui,
              "It is kept as it is, so the settings below do nothing. Replace it by a map that is "
              "made from the picture to use them; Undo brings it back.");
    CommandButton(ui, state, "make-depth", {-FLT_MIN, 0});
    Gap(ui);
  }
  ImportDepthFields(ui, state);
  TouchOrBrush(ui, state);
  if (PaintsDepth(state)) return BrushFields(ui, state);
  TouchFields(ui, state);
  Gap(ui);
  if (!is_imported) {
    ColourFilterField(ui, state);
    DepthHistogramFigure(ui, state);
    Gap(ui);
  }
  authoring::DepthOptions options = state.document().depth_options;
  // Relief stands out of the backdrop towards the incision and must not pass it.
  const double radius = document.scene.backdrop.radius;
  if (!is_imported && options.near_relief >= radius)
    ColouredText(ui,
                 fmt::format("The nearest tissue would lie behind the incision. Keep Near relief "
                             "below {:.0f} mm, the distance of the backdrop.",
                             MmFromMetres(radius)),
                 kWarning);
  ImGui::BeginDisabled(is_imported);
  const auto panel = OptionsPanel(ui, options, kMostRelief * radius, [&](std::string_view field) {
    return HasEffect(document.depth_options, field);
  });
  ImGui::EndDisabled();
  if (!panel.changed_field.empty()) SetDepthOptions(state, options, panel.changed_field);
  if (panel.held) state.dragging = true;
  if (panel.released) EndDrag(state);
  const std::string problem = state.steps.depth->cache.ProblemOf(state.document());
  if (!problem.empty()) ColouredText(ui, problem, kWarning);
  Gap(ui);
  if (Button(ui, "Back to the defaults", !is_imported, {-1, 0})) {
    SetDepthOptions(state, {}, "back to the defaults");
    EndDrag(state);
  }
}

}  // namespace arthro::app
