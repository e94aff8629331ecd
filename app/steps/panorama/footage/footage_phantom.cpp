// Footage of a digital knee, made beside the window: a clip to learn with where none is at hand.
#include "app/state/dialogs.h"
#include "app/steps/panorama/footage_work.h"
#include "authoring/phantom/clip/phantom_footage.h"
#include "authoring/phantom/phantom_io.h"

namespace arthro::app {

namespace {

constexpr int kSeed = 7;  // the knee of the manual's pictures

}  // namespace

void BrowseForPhantom(EditorState& state) {
  Browse(state, BrowseFor::kSaveFolder, "A new folder for the digital knee", "Make it", {},
         MakePhantomFootage, "digital-knee");
}

void MakePhantomFootage(EditorState& state, const std::filesystem::path& folder) {
  authoring::RequirePhantomFolder(folder);
  state.jobs.Start("Make a digital knee", [folder](const Progress& progress) {
    authoring::PhantomOptions options;
    options.seed = kSeed;
    authoring::WritePhantomWithFootage(folder, authoring::MakePhantom(options, progress), {},
                                       progress);
    return [folder](EditorState& now) { OpenFootage(now, folder / "footage"); };
  });
}

}  // namespace arthro::app
