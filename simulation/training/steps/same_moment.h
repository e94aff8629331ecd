// Moments of two attempts at one exercise that belong together: the same step, at the same share of
// it, whatever the time each of them took. s after the begin of each attempt.
#pragma once

#include <span>

#include "simulation/training/steps/step_result.h"

namespace arthro::simulation {

// Time in which a step was done: since the end of the step done before it, in any order; of another
// one from its begin.
struct StepTime {
  double begin = 0, end = 0;  // s
};
StepTime TimeOf(std::span<const StepResult> steps, const StepResult& step);

// Returns the moment of `other` that belongs to the moment `t` of `own`. Steps that were done lie
// between the ends of the steps done before them, in any order; of a step that was not done the
// clock counts from its begin. After the last step the other attempt stays at its end of that step.
double SameMoment(std::span<const StepResult> own, std::span<const StepResult> other, double t);

}  // namespace arthro::simulation
