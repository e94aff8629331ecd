// Commands for the lens from pictures of a grid.
#include "app/state/command.h"
#include "app/steps/practice/lens/grid_lens.h"

namespace arthro::app {
namespace {

constexpr Command kGridLensCommands[] = {
    {"grid-lens",
     "Pictures of a grid…",
     "Calibrate the lens of the scope from pictures of a line grid, chessboard or dot grid.",
     "Rig",
     {},
     {},
     [](const EditorState& state) { return InEditor(state) && Idle(state); },
     BrowseForGrid},
    {"save-grid-lens",
     "Save the lens…",
     "Write the calibrated lens into a file.",
     "Rig",
     {},
     {},
     HasGridLens,
     SaveGridLens,
     "First calibrate a lens from pictures of a grid."},
    {"use-grid-lens",
     "Use it here",
     "Let the scope of this scene have the calibrated lens.",
     "Rig",
     {},
     {},
     HasGridLens,
     UseGridLens,
     "First calibrate a lens from pictures of a grid."},
};

}  // namespace

std::span<const Command> GridLensCommands() { return kGridLensCommands; }

}  // namespace arthro::app
