#include "app/records/keeping/expert_attempt.h"

#include "app/records/attempts/attempts.h"
#include "app/records/people/reference_groups.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/attempt_head.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/scene_of_attempt.h"
#include "simulation/training/score/recorded_result.h"

namespace arthro::app {
namespace {

constexpr const char* kExperts = "experts";  // usual name of the group

bool IsOfExperts(const Exercise& exercise, const std::string& group) {
  bool has_named = false;
  for (const Criterion& criterion : exercise.criteria) {
    if (!criterion.max_from) continue;
    if (criterion.max_from->group == group) return true;
    has_named = true;
  }
  return !has_named && group == kExperts;
}

}  // namespace

std::optional<ExpertFile> FindExpertFile(const LoadedScene& loaded, const Exercise& exercise,
                                         Records* records, const std::string& own) {
  if (!exercise.ghost.empty()) return ExpertFile{FileOf(loaded, exercise.ghost), ""};
  if (records == nullptr) return std::nullopt;
  const std::string hash = HashOf(exercise);
  for (const ReferenceGroup& group : ReferenceGroupsOf(*records)) {
    if (group.exercise != hash || !IsOfExperts(exercise, group.name)) continue;
    for (const std::string& id : PassedAttemptsOf(*records, group))
      if (id != own) return ExpertFile{records->folder() / LogNameOf(id), group.name};
  }
  return std::nullopt;
}

ExpertAttempt ReadExpert(const LoadedScene& loaded, const Exercise& exercise,
                         const std::filesystem::path& file) {
  ExpertAttempt expert{simulation::ReadAttempt(file), {}};
  const simulation::AttemptHead head = simulation::AttemptHeadOf(expert.recording.head, file);
  if (const std::string why = simulation::WhyAnotherScene(head, loaded, exercise); !why.empty())
    throw Error(Code::kBadArgument, why, file);
  expert.result = simulation::ResultOfRecording(expert.recording, exercise, head.surfaces);
  return expert;
}

std::optional<ExpertAttempt> GhostOf(const LoadedScene& loaded, const Exercise& exercise) {
  if (exercise.ghost.empty()) return std::nullopt;
  try {
    return ReadExpert(loaded, exercise, FileOf(loaded, exercise.ghost));
  } catch (const Error&) {  // the check of the scene, and the look back, say why
    return std::nullopt;
  }
}

simulation::AttemptResult ResultBesideGhost(const LoadedScene& loaded, const Exercise& exercise,
                                            const simulation::RecordedAttempt& recording,
                                            std::span<const simulation::GroupValues> groups,
                                            const simulation::MetricLimits& limits) {
  const auto expert = GhostOf(loaded, exercise);
  simulation::GhostPath ghost;
  if (expert) ghost = {expert->recording.frames, expert->result.steps};
  return simulation::ResultOfRecording(recording, exercise, simulation::SurfaceNames(loaded.scene),
                                       groups, limits, expert ? &ghost : nullptr);
}

}  // namespace arthro::app
