// Attempt of an expert at the exercise that is looked back at: the recording that the scene names
// for it, or else the newest attempt of a reference group that was passed. Its pictures stand
// beside those of the trainee at the same step (simulation/training/steps/same_moment.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

struct Expert {
  std::vector<simulation::AttemptFrame> frames;
  std::vector<simulation::StepResult> steps;
  std::shared_ptr<simulation::TissueTrack> track;  // null: it was not recorded
};

// The expert of an exercise in the scene that is open; null, with a sentence about why and what to
// do, where there is none. `own`: attempt of the records that is no expert to itself.
std::shared_ptr<Expert> FindExpert(const EditorState& state, const Exercise& exercise,
                                   const std::string& own, std::string& words);
}  // namespace arthro::app
