#include "app/steps/depth/import_depth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/state/footage/measured_backdrop.h"
#include "app/steps/depth/depth_step.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

DepthMap ReliefOf(const EditorState& state, const DepthImport& import) {
  const auto& document = state.document();
  return authoring::ReliefFromNumbers(*import.numbers, import.options,
                                      document.scene.backdrop.radius, document.panorama->width,
                                      document.panorama->height, import.file);
}

}  // namespace

void ChooseDepthImport(EditorState& state, const std::filesystem::path& file) {
  state.jobs.Start("Read " + file.filename().string(), [file](const Progress&) -> Jobs::Apply {
    const auto numbers = Share(authoring::ReadGreyNumbers(file));
    return [file, numbers](EditorState& now) {
      DepthImport import{file, numbers, {}};
      // A guess, which the page shows and its author corrects: the backdrop lies behind all.
      const double radius = now.document().scene.backdrop.radius;
      import.options.high = radius;
      import.options.low = 0.5 * radius;
      float most = 0;
      for (const float value : numbers->values)
        if (std::isfinite(value)) most = std::max(most, value);
      import.options.unit = most > 1 ? 1e-3 : 1.0;  // millimetres, or metres
      now.steps.depth->import = std::move(import);
      now.steps.depth->import_words.clear();
      now.step = Step::kDepth;
      now.steps.depth->board.is_shown = false;
      now.message = "Say what the numbers of " + file.filename().string() + " mean.";
    };
  });
}

std::string WordsOfImport(const EditorState& state) {
  const auto& import = state.steps.depth->import;
  if (!import || !state.document().panorama) return "";
  try {
    const DepthMap relief = ReliefOf(state, *import);
    double low = 1e300, high = -1e300;
    for (const float height : relief.relief) {
      if (std::isnan(height)) continue;
      const double range = state.document().scene.backdrop.radius - static_cast<double>(height);
      low = std::min(low, range);
      high = std::max(high, range);
    }
    return fmt::format("The tissue will lie {:.1f} to {:.1f} mm from the portal.",
                       MmFromMetres(low), MmFromMetres(high));
  } catch (const Error& error) {
    return error.sentence();
  }
}

void TakeDepthImport(EditorState& state) {
  auto& import = state.steps.depth->import;
  if (!import || !state.document().panorama) return;
  const auto& document = state.document();
  MeasuredBackdrop backdrop;
  backdrop.panorama = document.panorama;
  backdrop.depth = Share(ReliefOf(state, *import));
  backdrop.projection = document.scene.backdrop.projection;
  backdrop.radius = document.scene.backdrop.radius;
  Edit(state, "Import the depth map " + import->file.filename().string(), "",
       [&](authoring::Document& next) { PutMeasuredDepth(next, backdrop); });
  import.reset();
  state.steps.depth->import_words.clear();
}

}  // namespace arthro::app
