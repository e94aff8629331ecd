// Frames of an attempt from recorded hands, and sight of the targets anew for frames that were
// observed in another scene or at another version of an exercise. A practice as it runs makes its
// frames itself (live_attempt.h).
#pragma once

#include <string>
#include <vector>

#include "simulation/practice/replay/replay.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

// Replays a recording in the scene and observes it as an attempt that begins with the first sample
// and ends with the exercise.
// A recording without wishes is in the state that the exercise begins in. Marks and answers of a
// trainee are in no recording of hands. Throws Error as Replay and PlacesOfTargets do.
std::vector<AttemptFrame> ObserveRecording(const LoadedScene& loaded, const Recording& recording,
                                           const Exercise& exercise,
                                           const SessionOptions& options = {},
                                           const Progress& progress = {},
                                           const std::vector<TissuePreset>& presets = {},
                                           std::vector<std::string>* messages = nullptr);

// Sees the targets of `exercise` anew in frames that have their hands already. Tissues are as at
// the begin of a session; volumes that were taken stay as they were observed.
void ObserveAnew(const LoadedScene& loaded, const Exercise& exercise,
                 std::vector<AttemptFrame>& frames);

}  // namespace arthro::simulation
