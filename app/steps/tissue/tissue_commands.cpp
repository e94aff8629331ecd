// Commands for the chosen tissue: its surface, mesh, balls, cuts.
#include <GLFW/glfw3.h>

#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/steps/tissue/tissue_cut.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

bool HasTissue(const State& state) {
  return Idle(state) && ShowsScope(state) && state.tissue >= 0 &&
         state.tissue < static_cast<int>(state.document().scene.tissues.size());
}

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

constexpr Command kCommands[] = {
    {"import-surface",
     "Import a surface…",
     "Add a tissue from an STL, OBJ, PLY, OFF or VTP file.",
     "Edit",
     {},
     {},
     [](const State& state) { return Idle(state) && HasPicture(state); },
     BrowseForSurface},
    {"tetrahedralise",
     "Make tetrahedra",
     "Fill the chosen tissue with tetrahedra.",
     "Edit",
     {},
     {},
     HasTissue,
     TetrahedraliseTissue},
    {"hold-brush",
     "Hold it here…",
     "Click on the tissue in either view. It is held there, in a ball of the radius above.",
     "Edit",
     {},
     {},
     HasTissue,
     ToggleBrush<BallKind::kHeld>},
    {"hold-at-instrument",
     "Hold it at the instrument",
     "Hold the chosen tissue where the instrument's tip is.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { AddBallAtInstrument(state, BallKind::kHeld); }},
    {"release-ball",
     "Release this one",
     "Remove the chosen ball.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return HasTissue(state) && state.steps.tissue->page == TissuePage::kHold &&
              HasChosenBall(state, BallKind::kHeld);
     },
     [](State& state) { RemoveChosenBall(state, BallKind::kHeld); }},
    {"release-tissue",
     "Release all",
     "Remove all balls. Nothing holds the tissue any more.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && HasBalls(state, BallKind::kHeld); },
     [](State& state) { RemoveAllBalls(state, BallKind::kHeld); }},
    {"probe-brush",
     "Finer here…",
     "Click on the tissue in either view. The next tetrahedra are finer there, in a ball of the "
     "radius above.",
     "Edit",
     {},
     {},
     HasTissue,
     ToggleBrush<BallKind::kProbed>},
    {"probe-at-instrument",
     "Finer at the instrument",
     "The next tetrahedra of the chosen tissue are finer where the instrument's tip is.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { AddBallAtInstrument(state, BallKind::kProbed); }},
    {"remove-probed",
     "Remove this place",
     "Remove the chosen place.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return HasTissue(state) && state.steps.tissue->page == TissuePage::kMesh &&
              HasChosenBall(state, BallKind::kProbed);
     },
     [](State& state) { RemoveChosenBall(state, BallKind::kProbed); }},
    {"remove-all-probed",
     "Remove all places",
     "Remove all places. The next tetrahedra are finer where the tissue is free.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && HasBalls(state, BallKind::kProbed); },
     [](State& state) { RemoveAllBalls(state, BallKind::kProbed); }},
    {"cut-tear",
     "Tear…",
     "Click points along the tear on the tissue in either view. Press again to end it.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kTear); }},
    {"cut-bite",
     "Bite…",
     "Click on the tissue in either view. A round bite is removed there.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kBite); }},
    {"remove-cut",
     "Remove this cut",
     "Make the tissue whole where the chosen cut is.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && ChosenCut(state) != nullptr; },
     RemoveChosenCut},
    {"remove-all-cuts",
     "Remove all cuts",
     "Make the tissue whole.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return HasTissue(state) &&
              !state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].cuts.empty();
     },
     RemoveAllCuts},
    {"cut-region",
     "Region…",
     "Click on the tissue in either view. The volume that a trainee removes in a ball around it "
     "is reported by name.",
     "Edit",
     {},
     {},
     HasTissue,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kRegion); }},
    {"remove-region",
     "Remove this region",
     "Remove the chosen region. The volume taken there counts for the rest of the tissue.",
     "Edit",
     {},
     {},
     [](const State& state) { return HasTissue(state) && ChosenRegion(state) != nullptr; },
     RemoveChosenRegion},
    {"tissue-before-scope",
     "Bring it before the scope",
     "Move the chosen tissue into the middle of the scope's view.",
     "Edit",
     {},
     {},
     HasTissue,
     BringBeforeScope},
    {"duplicate-tissue",
     "Duplicate",
     "Add a copy of the chosen tissue beside it.",
     "Edit",
     {GLFW_KEY_D, true},
     {},
     HasTissue,
     [](State& state) { DuplicateTissue(state, state.tissue); }},
    {"remove-tissue",
     "Remove",
     "Remove the chosen tissue from the scene.",
     "Edit",
     {GLFW_KEY_DELETE},
     {},
     HasTissue,
     [](State& state) { RemoveTissue(state, state.tissue); }},
};

}  // namespace

std::span<const Command> TissueCommands() { return kCommands; }

}  // namespace arthro::app
