// An attempt from a file: the log of an attempt that another station recorded, or recorded hands,
// which are replayed. It is judged as while it ran, in a job, and counts for nothing.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/records/attempts/attempt_record.h"
#include "app/records/keeping/expert_attempt.h"
#include "app/state/capital.h"
#include "app/state/command.h"
#include "app/state/dialogs.h"
#include "app/steps/lessons/instructor/rating_board.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/practice_step.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/scene/exercise/find_exercise.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/observed_recording.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Parts of the editor that the job reads.
struct AttemptFile {
  fs::path file;
  authoring::Document document;
  std::string chosen;  // id of the exercise; empty: none
  simulation::SessionOptions options;
  std::vector<simulation::TissuePreset> presets;
};

void AddSentence(std::string& notice, const std::string& sentence) {
  if (!sentence.empty()) notice += (notice.empty() ? "" : "\n") + Capital(sentence) + ".";
}

FinishedAttempt Judged(const AttemptFile& from, const Exercise& exercise,
                       simulation::RecordedAttempt attempt) {
  FinishedAttempt shown;
  shown.exercise = exercise;
  shown.result = ResultBesideGhost(from.document, exercise, attempt);
  AddSentence(shown.notice, attempt.torn);
  AddSentence(shown.notice, attempt.track_fault);
  shown.frames = std::move(attempt.frames);
  const auto track = std::make_shared<simulation::TissueTrack>(std::move(attempt.track));
  if (track->has_begun()) shown.track = track;
  return shown;
}

FinishedAttempt FromLog(const AttemptFile& from, const simulation::DeviceLogContent& log) {
  simulation::RecordedAttempt attempt = simulation::AttemptOf(log, from.file);
  const simulation::AttemptHead head = simulation::AttemptHeadOf(attempt.head, from.file);
  const auto& exercises = from.document.scene.exercises;
  const auto own = std::ranges::find(exercises, head.exercise, &Exercise::id);
  if (own == exercises.end())
    throw Error(Code::kBadArgument,
                fmt::format("this is an attempt at the exercise \"{}\" of the scene \"{}\", and "
                            "the scene that is open has no such exercise; open that scene first",
                            head.exercise, head.scene),
                from.file);
  if (const std::string why = simulation::WhyAnotherScene(head, from.document, *own); !why.empty())
    throw Error(Code::kBadArgument, why, from.file);
  FinishedAttempt shown = Judged(from, *own, std::move(attempt));
  shown.is_test = head.mode == ToString(AttemptMode::kTest);
  shown.is_robot = head.mode == ToString(AttemptMode::kRobot);
  if (!shown.is_robot) shown.started = head.started;  // a robot begins at no time of day
  shown.log = from.file;
  return shown;
}

// Marks and answers of a trainee are in no recording of hands: such steps stay open.
FinishedAttempt FromHands(const AttemptFile& from, const Progress& progress) {
  std::string notice;
  const simulation::Recording hands = simulation::ReadRecording(from.file, notice);
  if (from.chosen.empty())
    throw Error(Code::kBadArgument,
                "recorded hands do not say their exercise; first choose it on the page Exercises",
                from.file);
  const Exercise& exercise = ExerciseWithId(from.document.scene.exercises, from.chosen);
  std::vector<std::string> messages;
  simulation::RecordedAttempt attempt;
  attempt.frames = simulation::ObserveRecording(from.document, hands, exercise, from.options,
                                                progress, from.presets, &messages);
  FinishedAttempt shown = Judged(from, exercise, std::move(attempt));
  AddSentence(shown.notice, notice);
  for (const std::string& message : messages) AddSentence(shown.notice, message);
  return shown;
}

FinishedAttempt ReadAttemptFile(const AttemptFile& from, const Progress& progress) {
  const std::string bytes = ReadWholeFile(from.file);
  const auto log = simulation::IsDeviceLog(bytes) ? simulation::ParseDeviceLog(bytes, from.file)
                                                  : simulation::DeviceLogContent();
  FinishedAttempt shown =
      simulation::IsAttempt(log) ? FromLog(from, log) : FromHands(from, progress);
  shown.kept = fmt::format("From the file {}; it is not in the records and counts for nothing.",
                           from.file.filename().string());
  return shown;
}

}  // namespace

bool MayOpenAttempt(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return !state.practice && !step.running && !state.jobs.busy() &&
         !state.document().scene.exercises.empty();
}

void OpenAttemptFile(EditorState& state, const fs::path& file) {
  if (!MayOpenAttempt(state))
    throw Error(Code::kBadArgument,
                "an attempt is opened in a scene with exercises, while no practice and no other "
                "work is under way",
                file);
  const Exercise* chosen = ChosenExercise(state);
  AttemptFile from{file, state.document(), chosen != nullptr ? chosen->id : "",
                   state.steps.practice->session_options, state.tissue_presets};
  state.jobs.Start(
      "Open an attempt",
      [from = std::move(from),
       document = state.document_number](const Progress& progress) -> Jobs::Apply {
        return [shown = ReadAttemptFile(from, progress), document](EditorState& now) {
          LessonsStep& step = *now.steps.lessons;
          if (now.document_number != document || now.practice || step.running) return;
          const auto& exercises = now.document().scene.exercises;
          const auto own = std::ranges::find(exercises, shown.exercise.id, &Exercise::id);
          step.chosen = own == exercises.end() ? -1 : static_cast<int>(own - exercises.begin());
          step.finished = shown;
          step.debrief = {};
          step.rating->blinded_attempt.clear();
          step.page = LessonPage::kSummary;
        };
      });
}

void BrowseForAttempt(EditorState& state) {
  Browse(state, BrowseFor::kOpenFile, "Open an attempt or recorded hands", "Open",
         {{"Attempts", {".attempt", ".bin", ".csv"}}, {"All files", {}}},
         [](EditorState& now, const fs::path& file) {
           Guarded(now, "Open an attempt", [&] { OpenAttemptFile(now, file); });
         });
}

}  // namespace arthro::app
