// Import of an existing panorama: a picture, and the report with its projection.
#include <memory>

#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "authoring/panorama/report_io.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {

namespace fs = std::filesystem;

void ImportPanorama(EditorState& state, const fs::path& picture) {
  state.jobs.Start("Import " + picture.filename().string(), [picture](const Progress&) {
    auto panorama = std::make_shared<const ColourImage>(ReadColourImage(picture));
    return [picture, panorama](EditorState& now) {
      SetPanorama(now, "Import " + picture.filename().string(), panorama);
      now.step = Step::kPanorama;
      now.steps.panorama->shows_footage = false;
    };
  });
}

void ReadPanoramaReport(EditorState& state, const fs::path& report) {
  const authoring::ReportedView reported =
      authoring::ViewFromReport(ReadWholeFile(report, kMostJsonBytes), report);
  if (const auto& panorama = state.document().panorama;
      panorama && (reported.width != panorama->width || reported.height != panorama->height))
    throw Error(Code::kBadData,
                "the report is of a panorama of another size; choose the one that was written with "
                "this panorama",
                report);
  Backdrop backdrop = state.document().scene.backdrop;
  const double roll = backdrop.projection.roll;
  backdrop.projection = reported.projection;
  backdrop.projection.roll = roll;
  SetBackdrop(state, backdrop, "the projection");
}

}  // namespace arthro::app
