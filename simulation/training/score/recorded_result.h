// Result of an attempt from its recording: the same steps, metrics and criteria as while it ran
// [method.md, Score]. What trainee and instructor did beside moving the tools is read from the
// events.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/training/attempt_log.h"
#include "simulation/training/metrics/ghost_distance.h"
#include "simulation/training/score/criteria.h"
#include "simulation/training/steps/trainee_act.h"

namespace arthro::simulation {

// Acts of each frame, from the events that the step engine made of them.
std::vector<std::vector<TraineeAct>> ActsOf(std::span<const AttemptEvent> events,
                                            std::size_t frames);

// An engine that has taken the whole recording; an attempt that was cut short is stopped.
StepEngine EngineOfRecording(const RecordedAttempt& recording, const Exercise& exercise,
                             const MetricLimits& limits = {});

// `surfaces` and `ghost`: as MeasureExercise takes them.
AttemptResult ResultOfRecording(const RecordedAttempt& recording, const Exercise& exercise,
                                const std::vector<std::string>& surfaces,
                                std::span<const GroupValues> groups = {},
                                const MetricLimits& limits = {}, const GhostPath* ghost = nullptr);

}  // namespace arthro::simulation
