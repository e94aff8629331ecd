#include "app/steps/practice/rig_edit.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/project/every_instrument.h"
#include "simulation/core/error.h"
#include "simulation/device/hid/hid_link.h"
#include "simulation/practice/hands/offered_instruments.h"
#include "simulation/scene/json/rig_io.h"

namespace arthro::app {
namespace fs = std::filesystem;

namespace {

RigEditing& RigOf(EditorState& state) { return *state.steps.practice->rig; }

void Tell(EditorState& state, std::string words, bool is_fault = false) {
  RigEditing& editing = RigOf(state);
  editing.outcome = state.message = std::move(words);
  editing.is_fault = is_fault;
}

void Hold(EditorState& state, simulation::HandsChoice choice) {
  PracticeStep& step = *state.steps.practice;
  choice.is_zero_force = step.hands->is_zero_force();
  // The old devices are let go first, since a device is held by one at a time.
  step.hands->End();
  step.hands = std::make_unique<simulation::Hands>();
  step.hands = std::make_unique<simulation::Hands>(std::move(choice));
}

}  // namespace

bool IsShippedRig(const EditorState& state, const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(file, ignored).parent_path();
  return !state.steps.practice->rig_preset_folder.empty() &&
         folder == fs::weakly_canonical(state.steps.practice->rig_preset_folder, ignored);
}

RigFile PlainRig() {
  RigFile rig;
  rig.title = "My rig";
  RigRole& role = rig.instrument.emplace();
  role.device.family = RigFamilies().front();
  role.device.model = RigModels().front();
  return rig;
}

void OpenRig(EditorState& state, const fs::path& file) {
  RigFile rig = ReadRig(file);
  RigEditing& editing = RigOf(state);
  editing.rig = std::move(rig);
  editing.file = file;
  editing.is_changed = false;
  Tell(state, "Opened " + file.filename().string() + ".");
}

void SaveRigTo(EditorState& state, const fs::path& file) {
  if (IsShippedRig(state, file))
    throw Error(Code::kFile, "came with the program and stays as it is; save the rig elsewhere",
                file);
  RigEditing& editing = RigOf(state);
  WriteRig(file, editing.rig);
  editing.file = file;
  editing.is_changed = false;
  Tell(state, "Rig saved in " + file.string() + ".");
}

bool MayUseRig(const EditorState& state) {
  const RigEditing& editing = *state.steps.practice->rig;
  return Idle(state) && !state.practice && !state.steps.practice->poke && !editing.file.empty() &&
         !editing.is_changed;
}

void UseRig(EditorState& state) {
  try {
    Hold(state, simulation::ReadHands(RigOf(state).file, ""));
    Tell(state,
         fmt::format("The rig \"{}\" holds the hands of practices.", RigOf(state).rig.title));
  } catch (const Error& error) {
    Tell(state, error.what(), true);
  }
}

void UseNoRig(EditorState& state) {
  Hold(state, {});
  Tell(state, "Mouse and keys hold both hands.");
}

void FindDevices(EditorState& state) {
  std::string model;
  for (const auto& role : {RigOf(state).rig.scope, RigOf(state).rig.instrument})
    if (role && !role->device.model.empty()) model = role->device.model;
  state.jobs.Start("Look for devices", [model](const Progress&) {
    const auto bus = simulation::MachineHidBus();
    const auto survey =
        std::make_shared<simulation::DeviceSurvey>(simulation::SurveyDevices(*bus, model));
    return [survey](EditorState& now) {  // shared only because a std::function is copied
      RigEditing& editing = RigOf(now);
      editing.devices = survey->devices;
      Tell(now, editing.devices.empty() ? "No known device is plugged in."
                : editing.devices.size() == 1
                    ? "1 known device is plugged in."
                    : fmt::format("{} known devices are plugged in.", editing.devices.size()));
    };
  });
}

void OfferInstrument(EditorState& state, simulation::ToolKind kind, bool is_offered) {
  const Scene& scene = state.document().scene;
  std::vector<Instrument> own =
      scene.instruments.empty() ? authoring::EveryInstrument() : scene.instruments;
  const auto is_kind = [&](const Instrument& one) {
    return simulation::ToolKindFromString(one.kind) == kind;
  };
  if (!is_offered) {
    std::erase_if(own, is_kind);
    if (own.empty()) {
      Tell(state, "A scene offers at least one instrument.", true);
      return;
    }
  } else if (std::none_of(own.begin(), own.end(), is_kind)) {
    for (const Instrument& one : authoring::EveryInstrument())
      if (is_kind(one)) own.push_back(one);
  }
  if (own == scene.instruments) return;
  Edit(state, is_offered ? "Offer an instrument" : "Leave out an instrument", "",
       [&](authoring::Document& next) { next.scene.instruments = own; });
}

}  // namespace arthro::app
