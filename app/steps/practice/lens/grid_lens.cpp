#include "app/steps/practice/lens/grid_lens.h"

#include <fmt/format.h>

#include "app/state/command.h"
#include "app/state/dialogs.h"
#include "app/state/edits.h"
#include "app/state/footage/footage_optics.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/footage/picture_list.h"
#include "authoring/lens/grid/lens_from_pictures.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace fs = std::filesystem;

void BrowseForGrid(EditorState& state) {
  Browse(state, BrowseFor::kOpenFileOrFolder, "Pictures of a grid, of one size, or their folder",
         "Take them", {{"Pictures", {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"}}},
         LensFromGrid);
}

void LensFromGrid(EditorState& state, const fs::path& place) {
  std::vector<fs::path> files{place};
  if (fs::is_directory(place)) files = authoring::PicturesIn(place);
  state.jobs.Start("Calibrate the lens", [files, spacing = state.steps.practice->grid->spacing](
                                             const Progress& progress) {
    const std::shared_ptr<const authoring::PicturesLens> found =
        Share(authoring::LensFromPictures(files, spacing, {}, {}, progress));
    return [files, found](EditorState& now) {
      now.steps.practice->grid->pictures = files;
      now.steps.practice->grid->found = found;
      now.message = found->refusal.empty() ? "The lens was calibrated."
                                           : "There is no lens: " + found->refusal;
    };
  });
}

bool HasGridLens(const EditorState& state) {
  const auto& found = state.steps.practice->grid->found;
  return InEditor(state) && found && found->refusal.empty();
}

void SaveGridLens(EditorState& state) {
  Browse(
      state, BrowseFor::kSaveFile, "Save the lens", "Save", {{"Lens (.json)", {".json"}}},
      [](EditorState& now, const fs::path& file) {
        WriteLens(file, now.steps.practice->grid->found->calibration.lens);
        now.message = "Lens saved in " + file.string();
      },
      "lens.json");
}

void UseGridLens(EditorState& state) {
  authoring::Document changed = state.document();
  PutScopeLens(changed, state.steps.practice->grid->found->calibration.lens);
  Edit(state, "Change the lens", "", [&](auto& next) { next = changed; });
}

}  // namespace arthro::app
