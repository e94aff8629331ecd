#include "app/commands/devices/calibrate_incision.h"

#include <system_error>
#include <utility>

#include "app/commands/command_list.h"
#include "app/commands/scene_files.h"
#include "app/commands/start_practice.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using simulation::DeviceRole;

void Open(EditorState& state, DeviceRole role) {
  // The servo has the hands from its first call on, and their devices say how sharp they are.
  state.practice->Advance(0.0, state.hands.get());
  state.hands->Calibrate(role);
  const simulation::HandNow hand = state.hands->Now(role);
  const DeviceRig mount = state.hands->MountOf(role, state.document().scene);
  state.calibrating.emplace(PivotCalibrating{
      role,
      simulation::PivotWork(mount.rod_length, simulation::PivotOptionsOf(hand.situation.caps)), "",
      false});
  state.shows_devices = true;  // and there again, when it is closed
}

// The files that came with the program are everybody's.
bool IsShipped(const EditorState& state, const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(file, ignored).parent_path();
  return !state.rig_preset_folder.empty() &&
         folder == fs::weakly_canonical(state.rig_preset_folder, ignored);
}

void SaveInto(EditorState& state, const fs::path& file) {
  PivotCalibrating& own = *state.calibrating;
  if (IsShipped(state, file))
    throw Error(Code::kFile, "came with the program and stays as it is; save the rig elsewhere",
                file);
  state.hands->SaveRig(file);
  own.is_unsaved = false;
  own.outcome = "In use, and saved in " + file.string() + ".";
  state.message = "Rig saved in " + file.string();
}

}  // namespace

bool MayCalibrate(const EditorState& state, DeviceRole role) {
  return !state.calibrating && state.hands->WhyNotCalibrated(role).empty() &&
         (state.practice || MayPractise(state));
}

void CalibrateIncision(EditorState& state, DeviceRole role) {
  if (state.practice) return Open(state, role);
  StartPractice(state, [role](EditorState& now) { Open(now, role); });
}

void EndCalibration(EditorState& state) {
  state.calibrating.reset();
  state.hands->Calibrate({});
}

void KeepPivotFresh(EditorState& state) {
  if (state.pivot_jobs.busy())
    Guarded(state, "Calibration", [&] { state.pivot_jobs.Finish(state); });
  if (!state.calibrating) return;
  if (!state.practice) return EndCalibration(state);
  simulation::PivotWork& work = state.calibrating->work;
  simulation::DeviceSample sample;
  while (state.hands->ReadSample(sample)) work.Take(sample);
  if (state.pivot_jobs.busy()) return;
  if (auto fit = work.DueFit())
    state.pivot_jobs.Start("Calibration", [fit = std::move(*fit)](const Progress&) {
      return [fit, found = fit.Found()](EditorState& now) {
        if (now.calibrating) now.calibrating->work.TakeFit(fit, found);
      };
    });
}

void UseIncision(EditorState& state) {
  PivotCalibrating& own = *state.calibrating;
  const glm::dvec3 pivot = *own.work.found().pivot;
  state.hands->SetPivot(own.role, pivot);
  state.practice->SetMount(own.role, state.hands->MountOf(own.role, state.document().scene));
  state.message = std::string("The ") + ToString(own.role) + "'s incision is in use.";
  own.is_unsaved = state.hands->IsInRig(own.role);
  if (!own.is_unsaved) {
    own.outcome =
        "In use until the program ends: this hand comes from no rig file that could keep "
        "it.";
    return;
  }
  try {
    SaveInto(state, state.hands->rig_file());
  } catch (const Error& error) {
    own.outcome = std::string("In use, and not saved. ") + error.what();
  }
}

void SaveRigAs(EditorState& state) {
  const fs::path name = state.hands->rig_file().filename();
  Browse(
      state, BrowseFor::kSaveFile, "Save the rig with the incisions that were found", "Save",
      {{"Rig (.json)", {".json"}}},
      [](EditorState& now, const fs::path& file) {
        if (now.calibrating) SaveInto(now, file);
      },
      name.string());
}

}  // namespace arthro::app
