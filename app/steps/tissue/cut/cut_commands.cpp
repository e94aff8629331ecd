// Commands that cut the chosen tissue and name its regions.
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using State = EditorState;

constexpr Command kCutCommands[] = {
    {"cut-tear",
     "Tear…",
     "Click points along the tear on the tissue in either view. Press again to end it.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kTear); },
     "First choose a tissue."},
    {"cut-bite",
     "Bite…",
     "Click on the tissue in either view. A round bite is removed there.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kBite); },
     "First choose a tissue."},
    {"remove-cut",
     "Remove this cut",
     "Make the tissue whole where the chosen cut is.",
     "Edit",
     {},
     {},
     [](const State& state) { return IsTissueChosen(state) && ChosenCut(state) != nullptr; },
     RemoveChosenCut,
     "First choose a cut in the list."},
    {"remove-all-cuts",
     "Remove all cuts",
     "Make the tissue whole.",
     "Edit",
     {},
     {},
     [](const State& state) {
       return IsTissueChosen(state) &&
              !state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].cuts.empty();
     },
     RemoveAllCuts,
     "The tissue has no cuts."},
    {"cut-region",
     "Region…",
     "Click on the tissue in either view. The volume that a trainee removes in a ball around it "
     "is reported by name.",
     "Edit",
     {},
     {},
     IsTissueChosen,
     [](State& state) { ToggleCutBrush(state, CutBrush::Kind::kRegion); },
     "First choose a tissue."},
    {"remove-region",
     "Remove this region",
     "Remove the chosen region. The volume taken there counts for the rest of the tissue.",
     "Edit",
     {},
     {},
     [](const State& state) { return IsTissueChosen(state) && ChosenRegion(state) != nullptr; },
     RemoveChosenRegion,
     "First choose a region in the list."},
};

}  // namespace

std::span<const Command> CutCommands() { return kCutCommands; }

}  // namespace arthro::app
