// Distance of a tip from the way that an expert's tip took in the same steps [method.md, Metrics].
// Portal frame, m.
#pragma once

#include <optional>
#include <span>

#include "simulation/training/observe/attempt_frame.h"
#include "simulation/training/steps/step_result.h"

namespace arthro::simulation {

// Recording of an expert, as the exercise names it.
struct GhostPath {
  std::span<const AttemptFrame> frames;
  std::span<const StepResult> steps;
};

// Mean over the frames of the steps that both have done, without pauses, in which the tool is in
// the joint; nothing without such a frame.
std::optional<double> GhostDistance(std::span<const AttemptFrame> frames,
                                    std::span<const StepResult> steps, const GhostPath& ghost,
                                    DeviceRole role);

}  // namespace arthro::simulation
