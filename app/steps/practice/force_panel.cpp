// Options of contact, friction, limiter and tissue of the practices to come, folded away.
#include <imgui.h>

#include "app/panels/options_panel.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {

void ForcePanel(Ui& ui, EditorState& state) {
  ImGuiStorage& folds = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID("Forces");
  bool is_open = folds.GetBool(id);
  if (ToggleButton(ui, "Forces", is_open, true, {-FLT_MIN, 0},
                   "Contact, friction, limits and tissue of the next practice."))
    folds.SetBool(id, is_open = !is_open);
  if (!is_open) return;
  OptionsPanel(ui, state.steps.practice->session_options);
  if (Button(ui, "Back to the default forces", true, {-FLT_MIN, 0}))
    state.steps.practice->session_options = {};
}

}  // namespace arthro::app
