#include "app/steps/practice/calibrate_incision.h"

#include <utility>

#include "app/state/command.h"
#include "app/state/dialogs.h"
#include "app/steps/practice/rig_edit.h"
#include "app/steps/practice/start_practice.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using simulation::DeviceRole;

void Open(EditorState& state, DeviceRole role) {
  // The servo has the hands from its first call on, and their devices say how sharp they are.
  state.practice->Advance(0.0, state.steps.practice->hands.get());
  state.steps.practice->hands->Calibrate(role);
  const simulation::HandNow hand = state.steps.practice->hands->Now(role);
  DeviceRig mount = state.steps.practice->hands->MountOf(role, state.document().scene);
  if (role == DeviceRole::kInstrument)
    mount.rod_length +=
        state.steps.practice->hands->TipBeyondRod(state.practice->instrument_kind());
  state.steps.practice->calibrating.emplace(PivotCalibrating{
      role,
      simulation::PivotWork(mount.rod_length, simulation::PivotOptionsOf(hand.situation.caps)), "",
      false});
  state.steps.practice->shows_devices = true;  // and there again, when it is closed
}

void SaveInto(EditorState& state, const fs::path& file) {
  PivotCalibrating& own = *state.steps.practice->calibrating;
  if (IsShippedRig(state, file))
    throw Error(Code::kFile, "came with the program and stays as it is; save the rig elsewhere",
                file);
  state.steps.practice->hands->SaveRig(file);
  own.is_unsaved = false;
  own.outcome = "In use, and saved in " + file.string() + ".";
  state.message = "Rig saved in " + file.string();
}

}  // namespace

bool MayCalibrate(const EditorState& state, DeviceRole role) {
  return !state.steps.practice->calibrating &&
         state.steps.practice->hands->WhyNotCalibrated(role).empty() &&
         (state.practice || MayPractise(state));
}

void CalibrateIncision(EditorState& state, DeviceRole role) {
  if (state.practice) return Open(state, role);
  StartPractice(state, [role](EditorState& now) { Open(now, role); });
}

void EndCalibration(EditorState& state) {
  state.steps.practice->calibrating.reset();
  state.steps.practice->hands->Calibrate({});
}

void KeepPivotFresh(EditorState& state) {
  if (state.steps.practice->pivot_jobs.busy())
    Guarded(state, "Calibration", [&] { state.steps.practice->pivot_jobs.Finish(state); });
  if (!state.steps.practice->calibrating) return;
  if (!state.practice) return EndCalibration(state);
  simulation::PivotWork& work = state.steps.practice->calibrating->work;
  simulation::DeviceSample sample;
  while (state.steps.practice->hands->ReadSample(sample)) work.Take(sample);
  if (state.steps.practice->pivot_jobs.busy()) return;
  if (auto fit = work.DueFit())
    state.steps.practice->pivot_jobs.Start("Calibration", [fit = std::move(*fit)](const Progress&) {
      return [fit, found = fit.Found()](EditorState& now) {
        if (now.steps.practice->calibrating)
          now.steps.practice->calibrating->work.TakeFit(fit, found);
      };
    });
}

void UseIncision(EditorState& state) {
  PivotCalibrating& own = *state.steps.practice->calibrating;
  const glm::dvec3 pivot = *own.work.found().pivot;
  state.steps.practice->hands->SetPivot(own.role, pivot);
  state.practice->SetMount(own.role,
                           state.steps.practice->hands->MountOf(own.role, state.document().scene));
  state.message = std::string("The ") + ToString(own.role) + "'s incision is in use.";
  own.is_unsaved = state.steps.practice->hands->IsInRig(own.role);
  if (!own.is_unsaved) {
    own.outcome =
        "In use until the program ends: this hand comes from no rig file that could keep "
        "it.";
    return;
  }
  try {
    SaveInto(state, state.steps.practice->hands->rig_file());
  } catch (const Error& error) {
    own.outcome = std::string("In use, and not saved. ") + error.what();
  }
}

void SaveRigAs(EditorState& state) {
  const fs::path name = state.steps.practice->hands->rig_file().filename();
  Browse(
      state, BrowseFor::kSaveFile, "Save the rig with the incisions that were found", "Save",
      {{"Rig (.json)", {".json"}}},
      [](EditorState& now, const fs::path& file) {
        if (now.steps.practice->calibrating) SaveInto(now, file);
      },
      name.string());
}

}  // namespace arthro::app
