// Options of contact, friction, limiter and tissue, folded away. The session that runs takes those
// of the force at once; the depth field and the tissue are those of the next one.
#include <imgui.h>

#include "app/panels/options_panel.h"
#include "app/state/edits.h"
#include "app/steps/practice/practice_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

simulation::Practice* Session(EditorState& state) {
  if (state.practice) return &*state.practice;
  return state.steps.practice->poke ? &*state.steps.practice->poke : nullptr;
}

// Moves the incision of the running session alone; the scene keeps its own.
void SpacingField(Ui& ui, simulation::Practice& session) {
  constexpr double kMost = kMostIncisionSpacing / kMetrePerMillimetre;
  double mm = MmFromMetres(session.incision_spacing());
  if (Slider(ui, "Incision spacing of this session", mm, -kMost, kMost, "%.1f mm",
             "The scene keeps its own spacing, which the Portals page sets."))
    session.SetIncisionSpacing(MetresFromMm(mm));
}

}  // namespace

void ForcePanel(Ui& ui, EditorState& state) {
  ImGuiStorage& folds = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID("Forces");
  bool is_open = folds.GetBool(id);
  if (ToggleButton(ui, "Forces", is_open, true, {-FLT_MIN, 0},
                   "Contact, friction, limits and tissue. A running session takes the forces at "
                   "once, and depth and tissue when it begins."))
    folds.SetBool(id, is_open = !is_open);
  if (!is_open) return;
  PracticeStep& step = *state.steps.practice;
  simulation::Practice* session = Session(state);
  if (session != nullptr) SpacingField(ui, *session);
  bool is_changed = !OptionsPanel(ui, step.session_options).changed_field.empty();
  if (Button(ui, "Back to the default forces", true, {-FLT_MIN, 0})) {
    step.session_options = {};
    is_changed = true;
  }
  if (is_changed && session != nullptr)
    session->SetOptions(step.session_options, state.practice ? step.hands.get() : nullptr);
}

}  // namespace arthro::app
