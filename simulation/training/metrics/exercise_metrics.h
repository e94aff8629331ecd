// Metrics of an attempt at an exercise: those of MeasureAttempt, and those that need its targets,
// steps and events [method.md, Metrics]. SI units.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/training/metrics/ghost_distance.h"
#include "simulation/training/metrics/metrics.h"
#include "simulation/training/steps/step_engine.h"

namespace arthro::simulation {

// `engine` has taken all of `frames`. A metric that the exercise does not ask for is not measured,
// and says so. `ghost`: recording of the expert that the exercise names; null: it is not at hand.
std::vector<MetricValue> MeasureExercise(std::span<const AttemptFrame> frames,
                                         const StepEngine& engine,
                                         const std::vector<std::string>& surfaces,
                                         const MetricLimits& limits = {},
                                         const GhostPath* ghost = nullptr);

}  // namespace arthro::simulation
