// Commands for the chosen tissue: its surface, mesh and balls.
#include <GLFW/glfw3.h>

#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/tissue/fault_board.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

template <BallKind kind>
void ToggleBrush(State& state) {
  if (state.steps.tissue->brush == kind)
    state.steps.tissue->brush.reset();
  else
    state.steps.tissue->brush = kind;
  state.message = !state.steps.tissue->brush ? "The overview turns and moves again."
                  : kind == BallKind::kHeld
                      ? "Click on the tissue in either view to hold it there."
                      : "Click on the tissue in either view where its mesh should be finer.";
}

constexpr Command kTissueCommands[] = {
    {"import-surface",
     "Import a surface…",
     "Add a tissue from an STL, OBJ, PLY, OFF, VTP or VTU file.",
     "Edit",
     {},
     {},
     HasPictureAndTime,
     BrowseForSurface},
    {"tetrahedralise",
     "Make tetrahedra",
     "Fill the chosen tissue with tetrahedra.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     TetrahedraliseTissue,
     "First choose a tissue."},
    {"mend-surface",
     "Mend it",
     "Weld, orient and tidy the triangles of the chosen tissue, and fill its small holes.",
     "Edit",
     {},
     {},
     CanMendTissue,
     MendTissue,
     "Its surface has no fault that can be mended without doubt."},
    {"make-layer",
     "Make it a layer",
     "Give the open sheet a back at the distance on the left, so that it can be filled.",
     "Edit",
     {},
     {},
     CanMakeLayer,
     MakeTissueLayer,
     "Its surface is no open sheet."},
    {"hold-brush",
     "Hold it here…",
     "Click on the tissue in either view. It is held there, in a ball of the radius above.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     ToggleBrush<BallKind::kHeld>,
     "First choose a tissue."},
    {"hold-at-instrument",
     "Hold it at the instrument",
     "Hold the chosen tissue where the instrument's tip is.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     [](State& state) { AddBallAtInstrument(state, BallKind::kHeld); },
     "First choose a tissue."},
    {"release-ball",
     "Release this one",
     "Remove the chosen ball.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return IsTissueChosen(state) && state.steps.tissue->page == TissuePage::kHold &&
              HasChosenBall(state, BallKind::kHeld);
     },
     [](State& state) { RemoveChosenBall(state, BallKind::kHeld); },
     "First choose a ball in the list."},
    {"release-tissue",
     "Release all",
     "Remove all balls. Nothing holds the tissue any more.",
     "Edit",
     {},
     {},
     [](const State& state) { return IsTissueChosen(state) && HasBalls(state, BallKind::kHeld); },
     [](State& state) { RemoveAllBalls(state, BallKind::kHeld); },
     "No ball holds the tissue."},
    {"probe-brush",
     "Finer here…",
     "Click on the tissue in either view. The next tetrahedra are finer there, in a ball of the "
     "radius above.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     ToggleBrush<BallKind::kProbed>,
     "First choose a tissue."},
    {"probe-at-instrument",
     "Finer at the instrument",
     "The next tetrahedra of the chosen tissue are finer where the instrument's tip is.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     [](State& state) { AddBallAtInstrument(state, BallKind::kProbed); },
     "First choose a tissue."},
    {"remove-probed",
     "Remove this place",
     "Remove the chosen place.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return IsTissueChosen(state) && state.steps.tissue->page == TissuePage::kMesh &&
              HasChosenBall(state, BallKind::kProbed);
     },
     [](State& state) { RemoveChosenBall(state, BallKind::kProbed); },
     "First choose a place in the list."},
    {"remove-all-probed",
     "Remove all places",
     "Remove all places. The next tetrahedra are finer where the tissue is free.",
     "Edit",
     {},
     {},
     [](const State& state) { return IsTissueChosen(state) && HasBalls(state, BallKind::kProbed); },
     [](State& state) { RemoveAllBalls(state, BallKind::kProbed); },
     "There are no such places."},
    {"duplicate-tissue",
     "Duplicate",
     "Add a copy of the chosen tissue beside it.",
     "Edit",
     {GLFW_KEY_D, true},
     {},
     IsTissueChosen,
     [](State& state) { DuplicateTissue(state, state.tissue); },
     "First choose a tissue."},
    {"remove-tissue",
     "Remove",
     "Remove the chosen tissue from the scene.",
     "Edit",
     {GLFW_KEY_DELETE},
     {},
     IsTissueChosen,
     [](State& state) { RemoveTissue(state, state.tissue); },
     "First choose a tissue."},
};

}  // namespace

bool IsTissueChosen(const EditorState& state) {
  return Idle(state) && ShowsScope(state) && state.tissue >= 0 &&
         state.tissue < static_cast<int>(state.document().scene.tissues.size());
}

std::span<const Command> TissueCommands() { return kTissueCommands; }

}  // namespace arthro::app
