// Commands for rigs, and for the instruments that the scene offers.
#include "app/state/dialogs.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/rig_edit.h"
#include "simulation/practice/hands/offered_instruments.h"

namespace arthro::app {
namespace {

using State = EditorState;
namespace fs = std::filesystem;

bool HasRig(const State& state) {
  const RigFile& rig = state.steps.practice->rig->rig;
  return InEditor(state) && (rig.scope || rig.instrument);
}

void ToggleRig(State& state) {
  const bool is_in_sight = state.step == Step::kPractice;
  RigEditing& editing = *state.steps.practice->rig;
  editing.is_shown = !(editing.is_shown && is_in_sight);
  state.steps.practice->shows_devices = false;
  state.step = Step::kPractice;
}

void BrowseForRig(State& state) {
  Browse(state, BrowseFor::kOpenFile, "Open a rig", "Open", {{"Rig (.json)", {".json"}}}, OpenRig);
}

void BrowseToSaveRig(State& state) {
  const fs::path& file = state.steps.practice->rig->file;
  Browse(state, BrowseFor::kSaveFile, "Save the rig", "Save", {{"Rig (.json)", {".json"}}},
         SaveRigTo, file.empty() ? "rig.json" : file.filename().string());
}

void BeginRig(State& state) {
  RigEditing& editing = *state.steps.practice->rig;
  editing.rig = PlainRig();
  editing.file.clear();
  editing.is_changed = true;
  editing.outcome.clear();
  editing.is_shown = true;
  state.steps.practice->shows_devices = false;
  state.step = Step::kPractice;
}

bool MayHold(const State& state) {
  return Idle(state) && !state.practice && !state.steps.practice->poke;
}

template <simulation::ToolKind kind>
void ToggleOffer(State& state) {
  OfferInstrument(state, kind, !simulation::IsOffered(state.document().scene, kind));
}

constexpr Command kRigCommands[] = {
    {"rig",
     "Rig",
     "Choose, edit and save the devices that hold the two hands.",
     "Rig",
     {},
     {},
     InEditor,
     ToggleRig},
    {"open-rig", "Open a rig…", "Read a rig from its file.", "Rig", {}, {}, InEditor, BrowseForRig},
    {"new-rig",
     "New rig",
     "Begin a rig with one device for the instrument.",
     "Rig",
     {},
     {},
     InEditor,
     BeginRig},
    {"save-rig",
     "Save rig…",
     "Write the rig into a file.",
     "Rig",
     {},
     {},
     HasRig,
     BrowseToSaveRig,
     "First add a device to the rig."},
    {"use-rig",
     "Use this rig",
     "Let the devices of the saved rig hold the hands of practices.",
     "Rig",
     {},
     {},
     MayUseRig,
     UseRig,
     "First save the rig."},
    {"use-no-rig",
     "Mouse and keys",
     "Let mouse and keys hold both hands.",
     "Rig",
     {},
     {},
     MayHold,
     UseNoRig,
     "First end the poke."},
    {"find-devices",
     "Look for devices",
     "List the known devices that are plugged in.",
     "Rig",
     {},
     {},
     Idle,
     FindDevices},
    {"offer-probe",
     "Offer the probe",
     "Let the scene offer the probe in practice, or not.",
     "Rig",
     {},
     {},
     Idle,
     ToggleOffer<simulation::ToolKind::kProbe>},
    {"offer-punch",
     "Offer the punch",
     "Let the scene offer the punch in practice, or not.",
     "Rig",
     {},
     {},
     Idle,
     ToggleOffer<simulation::ToolKind::kPunch>},
    {"offer-shaver",
     "Offer the shaver",
     "Let the scene offer the shaver in practice, or not.",
     "Rig",
     {},
     {},
     Idle,
     ToggleOffer<simulation::ToolKind::kShaver>},
    {"offer-grasper",
     "Offer the grasper",
     "Let the scene offer the grasper in practice, or not.",
     "Rig",
     {},
     {},
     Idle,
     ToggleOffer<simulation::ToolKind::kGrasper>},
};

}  // namespace

std::span<const Command> RigCommands() { return kRigCommands; }

}  // namespace arthro::app
