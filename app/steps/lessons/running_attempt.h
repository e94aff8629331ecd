// An attempt that runs: frames of the practice, sight of the targets and steps of the exercise, all
// from the same values that its log keeps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/practice/hands/practice.h"
#include "simulation/training/observe/live_attempt.h"
#include "simulation/training/steps/step_engine.h"

namespace arthro::app {

struct RunningAttempt {
  // `practice` has not advanced yet and outlives this.
  RunningAttempt(const LoadedScene& loaded, const Exercise& exercise,
                 simulation::Practice& practice);

  simulation::LiveAttempt live;
  simulation::StepEngine engine;
  std::vector<simulation::AttemptFrame> frames;
  std::vector<simulation::TraineeAct> acts;  // acts for the frame to come
  std::size_t kept_events = 0;               // events that were handed to the log
};

}  // namespace arthro::app
