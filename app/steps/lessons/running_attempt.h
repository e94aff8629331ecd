// An attempt that runs: frames of the practice, sight of the targets and steps of the exercise, all
// from the same values that its log keeps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/practice/hands/practice.h"
#include "simulation/training/observe/live_attempt.h"
#include "simulation/training/steps/step_engine.h"
#include "simulation/training/track/track_recorder.h"

namespace arthro::app {

struct Expert;  // lookback/expert.h

struct RunningAttempt {
  // `practice` has not advanced yet and outlives this.
  RunningAttempt(const LoadedScene& loaded, const Exercise& exercise,
                 simulation::Practice& practice);

  simulation::LiveAttempt live;
  simulation::StepEngine engine;
  std::vector<simulation::AttemptFrame> frames;
  std::vector<simulation::TraineeAct> acts;  // acts for the frame to come
  bool is_paused = false;
  std::string rig;  // words of the devices that hold the hands
  simulation::TrackRecorder recorder;
  std::vector<simulation::TrackPiece> track;  // pieces of the tissue
  std::shared_ptr<Expert> expert;             // whose way a ghost shows; null: none
  // Events and pieces that were handed to the log.
  std::size_t kept_events = 0, kept_pieces = 0;
};

}  // namespace arthro::app
