// Lens of the scope on the rig page: step of the grid, its pictures, and the verdict.
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/steps/practice/lens/grid_lens.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/lens/grid/lens_from_pictures.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace {

void Verdict(Ui& ui, const GridLens& grid) {
  const authoring::LensCalibration& calibration = grid.found->calibration;
  if (!grid.found->refusal.empty()) {
    ColouredText(ui, "There is no lens: " + grid.found->refusal, kBad);
    return;
  }
  const bool is_good = calibration.verdict == authoring::LensVerdict::kGood;
  int used = 0;
  double squares = 0;
  for (const authoring::ViewReport& view : calibration.views)
    if (view.target.kind != authoring::TargetKind::kNone)
      ++used, squares += view.rms_px * view.rms_px;
  ColouredText(ui,
               fmt::format("{} of {} pictures used; {:.2f} px rms", used, calibration.views.size(),
                           used > 0 ? std::sqrt(squares / used) : 0.0),
               is_good ? kGood : kWarning);
  QuietText(ui, fmt::format("Model {}, {:.0f}° wide, error at the rim about {:.1f} px",
                            ToString(calibration.lens.model),
                            DegreesFromRadians(calibration.lens.field_of_view),
                            calibration.rim_error_px));
  if (!is_good)
    for (const std::string& sentence : calibration.sentences) QuietText(ui, sentence);
}

}  // namespace

void GridLensFields(Ui& ui, EditorState& state) {
  Heading(ui, "Lens of the scope");
  GridLens& grid = *state.steps.practice->grid;
  double mm = MmFromMetres(grid.spacing);
  if (Slider(ui, "Step of the grid", mm, 0.1, 50, "%.2f mm",
             "From line to line, corner to corner or dot to dot."))
    grid.spacing = MetresFromMm(mm);
  CommandButton(ui, state, "grid-lens", {-FLT_MIN, 0});
  if (!grid.found) {
    QuietText(ui, "Six pictures of a grid are best, tilted to all sides and filling the window.");
    return;
  }
  Verdict(ui, grid);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(8)) / 2;
  CommandButton(ui, state, "save-grid-lens", {half, 0});
  ImGui::SameLine(0, ui.Px(8));
  CommandButton(ui, state, "use-grid-lens", {half, 0});
}

}  // namespace arthro::app
