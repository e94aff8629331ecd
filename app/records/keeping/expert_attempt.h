// Attempt of an expert at an exercise: the recording that its scene names, or else the newest
// passed attempt of a reference group. Groups of experts are those that the criteria of the
// exercise name, or the one called "experts".
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "app/records/store/records.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/attempt_result.h"
#include "simulation/training/score/criteria.h"

namespace arthro::app {

struct ExpertFile {
  std::filesystem::path file;
  std::string group;  // name in the records; empty: the scene names it
};

// `exercise`: of the scene. `records` null: none are reached. `own`: attempt of the records that is
// no expert to itself.
std::optional<ExpertFile> FindExpertFile(const LoadedScene& loaded, const Exercise& exercise,
                                         Records* records, const std::string& own);

struct ExpertAttempt {
  simulation::RecordedAttempt recording;
  simulation::AttemptResult result;
};
// Throws Error for a recording that cannot be read, or of another scene or exercise.
ExpertAttempt ReadExpert(const LoadedScene& loaded, const Exercise& exercise,
                         const std::filesystem::path& file);

// The recording that the exercise itself names, for ghost_distance; nothing where it names none, or
// one that cannot be read.
std::optional<ExpertAttempt> GhostOf(const LoadedScene& loaded, const Exercise& exercise);

// Result of a recording in this scene, with its distance from that recording of an expert.
simulation::AttemptResult ResultBesideGhost(const LoadedScene& loaded, const Exercise& exercise,
                                            const simulation::RecordedAttempt& recording,
                                            std::span<const simulation::GroupValues> groups = {},
                                            const simulation::MetricLimits& limits = {});

}  // namespace arthro::app
