// Rigs in the window: chosen from a file, edited, saved, and put to use for the two hands; and the
// instruments that the scene offers. A rig belongs to a place and not to the scene, so that its
// changes are no steps of the history.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "app/state/command.h"
#include "simulation/device/live/device_survey.h"
#include "simulation/scene/json/rig_file.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::app {

struct RigEditing {
  bool is_shown = false;       // its page, instead of the practice's
  RigFile rig;                 // rig on the page
  std::filesystem::path file;  // file that it was read from or written to; empty: none
  bool is_changed = false;     // since then
  std::string outcome;         // result of the last command; empty: none
  bool is_fault = false;       // true where `outcome` names a fault
  // Devices that were found when they were last looked for.
  std::vector<simulation::SurveyedDevice> devices;
};

// A rig of one device that reaches the default mount, with a title.
RigFile PlainRig();

// True for a file that came with the program, which stays as it is.
bool IsShippedRig(const EditorState& state, const std::filesystem::path& file);

// Throw Error.
void OpenRig(EditorState& state, const std::filesystem::path& file);
void SaveRigTo(EditorState& state, const std::filesystem::path& file);

// Makes the saved rig that of the two hands. Not while a practice runs.
bool MayUseRig(const EditorState& state);
void UseRig(EditorState& state);
// Lets mouse and keys hold both hands.
void UseNoRig(EditorState& state);
// Lists the plugged-in devices, beside the window.
void FindDevices(EditorState& state);

// Lists an instrument in the scene, or leaves it out; one step of the history. The last one stays.
void OfferInstrument(EditorState& state, simulation::ToolKind kind, bool is_offered);

}  // namespace arthro::app
