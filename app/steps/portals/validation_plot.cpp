#include "app/steps/portals/validation_plot.h"

#include <fmt/format.h>

#include "app/steps/portals/centres_figure.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

void Save(EditorState& state, const fs::path& picture) {
  const fs::path stem = picture.parent_path() / picture.stem();
  const fs::path grid = fs::path(stem) += "-grid.png", table = fs::path(stem) += ".csv";
  std::error_code ignored;
  // Consent to replace the picture covers all three files.
  if (!fs::exists(picture, ignored))
    for (const fs::path& beside : {grid, table})
      if (fs::exists(beside, ignored))
        throw Error(Code::kFile, "is already there and would be overwritten; choose another name",
                    beside);
  CentresChoice choice;
  choice.view_angle =
      state.practice ? state.practice->view_angle() : state.document().scene.scope.view_angle;
  // Before anything is written: what cannot be drawn is said.
  CentresFigure figure = CentresOf(state.document().scene.backdrop, choice);
  state.jobs.Start("Validation plot", [picture, grid, table, figure = std::move(figure),
                                       panorama = state.document().panorama](const Progress&) {
    ColourImage drawn = *panorama;
    DrawCentres(drawn, figure.rod, figure.lines);
    WriteColourImage(picture, drawn);
    drawn = GridOf(panorama->width, panorama->height);
    DrawCentres(drawn, figure.rod, figure.lines);
    WriteColourImage(grid, drawn);
    WriteAtomically(table, figure.table);
    return [picture, grid, table](EditorState& now) {
      now.message = fmt::format("Validation plot: {}, {} and {} in {}", picture.filename().string(),
                                grid.filename().string(), table.filename().string(),
                                picture.parent_path().string());
    };
  });
}

}  // namespace

void SaveValidationPlot(EditorState& state) {
  Browse(
      state, BrowseFor::kSaveFile,
      "Save the centres of the view at 5, 10 and 15 mm, on the panorama and on a grid", "Save",
      {{"Picture (.png)", {".png"}}},
      [](EditorState& now, const fs::path& file) { Save(now, file); }, "validation");
}

}  // namespace arthro::app
