// Faults of the chosen surface on the Mesh page, in the colours in which the overview draws them.
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/widgets.h"
#include "app/steps/tissue/fault_board.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {

void FaultFields(Ui& ui, EditorState& state) {
  const auto found = FaultsOfChosen(state);
  if (!found) return QuietText(ui, "Its surface is being checked…");
  if (found->faults.empty()) return QuietText(ui, "Its surface has no faults.");
  for (const authoring::SurfaceFault& fault : found->faults) {
    const glm::dvec3 colour = ColourOf(fault.kind);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float edge = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(
        at, {at.x + edge, at.y + edge},
        ImGui::GetColorU32({static_cast<float>(colour.r), static_cast<float>(colour.g),
                            static_cast<float>(colour.b), 1.0f}),
        ui.Px(2));
    ImGui::Dummy({edge, edge});
    ImGui::SameLine(0, ui.Px(6));
    Text(ui, fault.sentence);
  }
  if (found->CanBeMended()) CommandButton(ui, state, "mend-surface", {-FLT_MIN, 0});
  if (found->Has(authoring::FaultKind::kSheet)) {
    const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
    double mm = MmFromMetres(state.steps.tissue->faults->thickness);
    ImGui::SetNextItemWidth(half);
    if (NumberField(ui, "Layer", mm, 0.05, -10, 10, "%.1f mm",
                    "Thickness behind the triangles; negative: in front of them."))
      state.steps.tissue->faults->thickness = MetresFromMm(mm);
    ImGui::SameLine(0, ui.Px(8));
    CommandButton(ui, state, "make-layer", {half, 0});
  }
  Gap(ui);
}

}  // namespace arthro::app
