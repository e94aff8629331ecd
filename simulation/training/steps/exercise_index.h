// Targets of an exercise by their numbers, so that no frame compares names.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/exercise/exercise.h"
#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

// Number of the target `id`; −1: there is none.
int TargetIndex(const Exercise& exercise, const std::string& id);
// Numbers of the targets that a step names: its targets, path, bodies, regions or source.
std::vector<int> TargetsOf(const Exercise& exercise, const ExerciseStep& step);
// Number of the step `id`; −1: there is none.
int StepIndex(const Exercise& exercise, const std::string& id);

// Place of a target in a frame. A ball in space has one without an observation too; nothing: not
// observed, or cut away.
std::optional<glm::dvec3> PlaceOf(const Exercise& exercise, const AttemptFrame& frame, int target);

// Loose bodies of the exercise that has these targets, where they are in a frame.
std::vector<Ball> LooseBodiesIn(std::span<const ExerciseTarget> targets, const AttemptFrame& frame);

// True for kinds of steps that are done with the instrument.
bool UsesInstrument(const ExerciseStep& step);

}  // namespace arthro::simulation
