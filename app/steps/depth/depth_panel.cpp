// Step 2: how the panorama's brightness becomes relief.
#include <cfloat>

#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/panels/options_panel.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"

namespace arthro::app {

void DepthPanel(Ui& ui, EditorState& state) {
  const authoring::Document document = state.document();  // a copy: edits below move it
  if (!document.panorama) {
    QuietText(ui, "Depth is made from a panorama; import one first.");
    return;
  }
  const bool is_imported = document.is_depth_imported;
  if (is_imported) {
    Text(ui, "This scene has a depth map that was imported, not made from its picture.");
    QuietText(ui,
              "It is kept as it is, so the settings below do nothing. Replace it by a map that is "
              "made from the picture to use them; Undo brings the imported one back.");
    CommandButton(ui, state, "make-depth", {-FLT_MIN, 0});
    Gap(ui);
  }
  authoring::DepthOptions options = document.depth_options;
  ImGui::BeginDisabled(is_imported);
  const auto panel = OptionsPanel(ui, options);
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
