// Rules of each kind of step for a frame [method.md, Exercises]. One call per frame; pauses, limits
// and the order of steps are the engine's (step_engine.h).
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/training/steps/attempt_event.h"
#include "simulation/training/steps/attempt_measures.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/steps/step_result.h"
#include "simulation/training/steps/step_state.h"
#include "simulation/training/steps/trainee_act.h"

namespace arthro::simulation {

inline constexpr double kJawsClosed = 0.3;  // opening below which jaws hold, and have bitten

// Receives the events of a step.
class StepEvents {
 public:
  virtual ~StepEvents() = default;
  // `target`: number in the exercise; −1: none.
  virtual void Add(EventKind kind, int target, double value, std::string_view note) = 0;
};

struct StepFrame {
  const Exercise& exercise;
  const AttemptFrame& frame;
  std::span<const TraineeAct> acts;
  AttemptMeasures& measures;
  StepEvents& events;
};

// Sizes of the state for a step that starts in this frame.
void StartStep(const ExerciseStep& step, const StepFrame& at, StepState& state);

// kRunning, kDone or kFailed. `next` gets the step that a chosen answer names.
StepOutcome AdvanceStep(const ExerciseStep& step, const StepFrame& at, StepState& state,
                        std::string* next);

// Place of a step's goal now, for the picture; nothing for steps without a moving goal.
std::optional<glm::dvec3> MovingGoal(const ExerciseStep& step, const StepFrame& at,
                                     const StepState& state);

// Target that a step asks for now, whose cue is due.
struct StripCue {
  int step = -1, target = -1;  // numbers in the exercise
  CueKind kind = CueKind::kNone;
  friend bool operator==(const StripCue&, const StripCue&) = default;
};

// Adds the targets that a step asks for now: of a ring the next one, of a body in the grasper its
// goal, else those that are not done.
void AddCues(int number, const StepFrame& at, const StepState& state, std::vector<StripCue>& cues);

// Forces between which the step wants the tip; nothing for others.
std::optional<glm::dvec2> ForceBandOf(const ExerciseStep& step);

}  // namespace arthro::simulation
