#include "app/steps/lessons/lookback/expert.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/records/keeping/expert_attempt.h"
#include "app/state/edits.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/lookback/touches.h"
#include "app/steps/lessons/running_attempt.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/attempt_head.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

// The exercise of the open scene that an attempt was made at; null: it has another one by now.
const Exercise* SameExercise(const EditorState& state, const Exercise& exercise) {
  const auto& exercises = state.document().scene.exercises;
  const auto own = std::ranges::find(exercises, exercise.id, &Exercise::id);
  return own != exercises.end() && HashOf(*own) == HashOf(exercise) ? &*own : nullptr;
}

}  // namespace

std::shared_ptr<Expert> FindExpert(const EditorState& state, const Exercise& exercise,
                                   const std::string& own, std::string& words) {
  const Exercise* of_scene = SameExercise(state, exercise);
  if (of_scene == nullptr) {
    words = "The scene that is open has this exercise no longer as it was, so no expert is shown.";
    return nullptr;
  }
  try {
    Records* records = state.steps.lessons->records->open.get();
    if (const auto found = FindExpertFile(state.document(), *of_scene, records, own)) {
      ExpertAttempt read = ReadExpert(state.document(), *of_scene, found->file);
      auto expert = std::make_shared<Expert>();
      expert->steps = read.result.steps;
      expert->frames = std::move(read.recording.frames);
      auto track = std::make_shared<simulation::TissueTrack>(std::move(read.recording.track));
      if (track->has_begun()) expert->track = std::move(track);
      words = found->group.empty()
                  ? "Expert: the recording of the scene"
                  : fmt::format("Expert: an attempt of the group {}", found->group);
      return expert;
    }
  } catch (const Error& fault) {
    words = fmt::format("The expert's attempt cannot be shown: {}", fault.what());
    return nullptr;
  }
  words =
      "No expert is recorded for this exercise. Pass it as an expert would, then choose \"Use as "
      "expert's\" on the page of the result.";
  return nullptr;
}

void ReadGhost(EditorState& state) {
  RunningAttempt& running = *state.steps.lessons->running;
  const Exercise& exercise = running.engine.exercise();
  const bool has_ghost = std::ranges::any_of(
      exercise.steps, [](const ExerciseStep& step) { return BaseOf(step).cue == CueKind::kGhost; });
  std::string words;  // without an expert the cue is an outline
  if (has_ghost) running.expert = FindExpert(state, exercise, "", words);
}

void OpenDebrief(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  step.page = LessonPage::kDebrief;
  if (!step.finished) return;
  step.debrief.touches = TouchesOf(step.finished->frames);
  if (step.debrief.expert) return;
  step.debrief.expert =
      FindExpert(state, step.finished->exercise, step.finished->id, step.debrief.expert_words);
}

bool MayBeExpert(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return !state.practice && !state.practice_only && step.finished && !step.finished->log.empty() &&
         step.finished->result.outcome == simulation::AttemptOutcome::kPassed &&
         SameExercise(state, step.finished->exercise) != nullptr;
}

void UseAsExpert(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  const std::string id = step.finished->exercise.id;
  const std::string bytes = ReadWholeFile(step.finished->log);
  const simulation::AttemptHead head = simulation::AttemptHeadOf(
      simulation::AttemptOf(simulation::ParseDeviceLog(bytes, step.finished->log)).head);
  if (const std::string why = simulation::WhyAnotherScene(
          head, state.document(), *SameExercise(state, step.finished->exercise));
      !why.empty())
    throw Error(Code::kBadArgument, why);
  const std::filesystem::path name = "expert-" + id + ".attempt";
  const std::filesystem::path file = state.scratch.NewFile(name);
  WriteAtomically(file, bytes, Access::kPrivate);
  Edit(state, "Expert's attempt", "", [&](authoring::Document& document) {
    for (Exercise& exercise : document.scene.exercises)
      if (exercise.id == id) exercise.ghost = name;
    document.files[name.generic_string()] = {file, {}, {}};
  });
  step.debrief.expert.reset();
  state.message = "This attempt is the expert's of the exercise. Save the scene to keep it.";
}

}  // namespace arthro::app
