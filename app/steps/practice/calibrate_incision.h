// Finding a hand's incision in the window: begun from the Devices panel, done in a practice, with
// no force on any device; taken over at once, and saved in the rig's file.
#pragma once

#include <filesystem>

#include "app/steps/practice/practice_step.h"

namespace arthro::app {

// In the practice that runs, or in one that is begun for it.
bool MayCalibrate(const EditorState& state, simulation::DeviceRole role);
void CalibrateIncision(EditorState& state, simulation::DeviceRole role);
void EndCalibration(EditorState& state);

// Once a frame, after the practice: takes what the device said, and fits a swing beside the window.
void KeepPivotFresh(EditorState& state);

// Makes the pivot that was found that of the hand, and saves it in the rig's file. A pivot that
// cannot be saved is used all the same, and the panel says so.
void UseIncision(EditorState& state);
void SaveRigAs(EditorState& state);  // asks where

}  // namespace arthro::app
