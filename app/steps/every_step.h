// The groups that the list of commands is made of, and when a command can be called.
#pragma once

#include <span>

#include "app/state/command.h"
#include "app/steps/panorama/footage_work.h"

namespace arthro::app {

std::span<const Command> SceneCommands();        // files, footage, undo
std::span<const Command> TissueCommands();       // what is done to the selected tissue
std::span<const Command> IncisionCommands();     // their calibration
std::span<const Command> PracticeCommands();     // steps, practice, window
std::span<const Command> DisturbanceCommands();  // of a practice's picture

inline bool Always(const EditorState&) { return true; }
inline bool InEditor(const EditorState& state) { return !state.practice && !state.practice_only; }
inline bool Idle(const EditorState& state) { return InEditor(state) && !state.jobs.busy(); }
inline bool HasPicture(const EditorState& state) {
  return InEditor(state) && state.document().panorama != nullptr;
}
inline bool ShowsScope(const EditorState& state) { return !ShowsFootage(state); }

}  // namespace arthro::app
