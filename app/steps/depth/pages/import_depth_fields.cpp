// Import of a depth map and preview of the touch on the Depth page.
#include <algorithm>
#include <cfloat>

#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/options_panel.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "simulation/core/units.h"

namespace arthro::app {

void ImportDepthFields(Ui& ui, EditorState& state) {
  auto& import = state.steps.depth->import;
  if (!import) {
    CommandButton(ui, state, "import-depth", {-FLT_MIN, 0});
    return;
  }
  Heading(ui, "Import " + import->file.filename().string());
  authoring::DepthImportOptions& options = import->options;
  bool has_changed = state.steps.depth->import_words.empty();
  int meaning = static_cast<int>(options.meaning);
  if (Combo(ui, "Its numbers are", meaning,
            {"distances from the portal", "heights over the backdrop"})) {
    options.meaning = static_cast<authoring::DepthMeaning>(meaning);
    has_changed = true;
  }
  if (import->numbers->white > 0) {
    double low = MmFromMetres(options.low), high = MmFromMetres(options.high);
    if (NumberField(ui, "Black is", low, 0.1, -500, 2000, "%.1f mm")) {
      options.low = MetresFromMm(low);
      has_changed = true;
    }
    if (NumberField(ui, "White is", high, 0.1, -500, 2000, "%.1f mm")) {
      options.high = MetresFromMm(high);
      has_changed = true;
    }
  } else {
    constexpr double kUnits[] = {1.0, 1e-2, 1e-3, 1e-6};  // m
    int unit = static_cast<int>(std::find(std::begin(kUnits), std::end(kUnits), options.unit) -
                                std::begin(kUnits));
    if (Combo(ui, "Unit", unit, {"metre", "centimetre", "millimetre", "micrometre"})) {
      options.unit = kUnits[unit];
      has_changed = true;
    }
  }
  if (Checkbox(ui, "0 means not known", options.is_zero_unknown)) has_changed = true;
  if (has_changed) state.steps.depth->import_words = WordsOfImport(state);
  Text(ui, state.steps.depth->import_words);
  CommandButton(ui, state, "take-depth-import", {-FLT_MIN, 0});
  CommandButton(ui, state, "drop-depth-import", {-FLT_MIN, 0});
  Gap(ui);
}

void TouchFields(Ui& ui, EditorState& state) {
  TouchPreview& touch = state.steps.depth->touch;
  if (!touch.is_on) return;
  double press = MmFromMetres(touch.press);
  if (Slider(ui, "Press", press, 0.1, 5, "%.1f mm", "Depth of the probe's tip below the surface."))
    touch.press = MetresFromMm(press);
  if (!touch.probe)
    QuietText(ui, "The force is being prepared.");
  else if (!touch.reading)
    QuietText(ui, "Point at the tissue in the scope's picture, the overview or the map.");
  else
    Text(ui, WordsOfTouch(state, *touch.reading) + ".");
}

}  // namespace arthro::app
