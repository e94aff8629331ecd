// Attempts of the records in the window: the result and the look back as right after the practice,
// and the report as a file.

#include <algorithm>

#include <fmt/format.h>

#include "app/records/attempts/records_file.h"
#include "app/report/make_report.h"
#include "app/state/command.h"
#include "app/steps/lessons/instructor/rating_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/lessons_step.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

// Frames of the attempt; none, with a notice, where its log is damaged or on another station.
std::vector<simulation::AttemptFrame> FramesOf(const EditorState& state, const Records& records,
                                               const AttemptRecord& record, std::string& notice) {
  try {
    auto recording = simulation::ReadAttempt(records.folder() / record.log);
    if (!simulation::IsOfScene(simulation::AttemptHeadOf(recording.head), state.document()))
      notice = fmt::format(
          "This attempt was made in the scene \"{}\" as it was then; open that one to look back in "
          "it. The picture shows the scene that is open.",
          record.scene);
    return std::move(recording.frames);
  } catch (const Error& fault) {
    notice = fmt::format("The look back is not there, and the result is: {}", fault.what());
    return {};
  }
}

AttemptReport ReportOfShown(EditorState& state, const FinishedAttempt& attempt) {
  LessonRecords& records = *state.steps.lessons->records;
  if (!attempt.id.empty() && records.open) try {
      std::string notice;
      return ReportFromRecords(*records.open, attempt.id, notice);
    } catch (const Error&) {  // it waits in the outbox
    }
  AttemptReport report = MakeReport(attempt.exercise, attempt.result, attempt.frames);
  report.attempt.id = attempt.id;
  report.attempt.scene = state.document().scene.title;
  report.attempt.mode = attempt.is_test ? AttemptMode::kTest : AttemptMode::kPractice;
  report.is_mode_known = true;
  report.trainee = attempt.trainee;
  return report;
}

}  // namespace

void ShowStoredAttempt(EditorState& state, const std::string& id) {
  LessonsStep& step = *state.steps.lessons;
  if (!ReachRecords(*step.records)) throw Error(Code::kFile, step.records->fault);
  Records& records = *step.records->open;
  const RecordsBundle bundle = ReadBundleOf(records, id);
  const AttemptRecord& record = bundle.attempts.at(0);
  FinishedAttempt shown;
  shown.exercise = ExerciseFromJson(bundle.exercises.at(0).json);
  shown.trainee = bundle.trainees.at(0).code;
  shown.is_test = record.mode == AttemptMode::kTest;
  shown.result = ResultOf(record);
  shown.frames = FramesOf(state, records, record, shown.notice);
  shown.id = id;
  shown.started = record.started;
  const auto& exercises = state.document().scene.exercises;
  const auto own = std::ranges::find(exercises, shown.exercise.id, &Exercise::id);
  step.chosen = own == exercises.end() ? -1 : static_cast<int>(own - exercises.begin());
  step.finished = std::move(shown);
  step.debrief = {};
  step.rating->blinded_attempt.clear();
  step.page = LessonPage::kSummary;
}

void SaveReport(EditorState& state) {
  const FinishedAttempt& attempt = *state.steps.lessons->finished;
  Browse(
      state, BrowseFor::kSaveFile, "Save the report of this attempt", "Save",
      {{"Pages", {".html"}}},
      [](EditorState& now, const std::filesystem::path& file) {
        if (!now.steps.lessons->finished) return;
        Guarded(now, "Report", [&] {
          WriteAtomically(file, AttemptPage(ReportOfShown(now, *now.steps.lessons->finished)),
                          Access::kPrivate);
          now.message = "The report is in " + file.string() + ".";
        });
      },
      fmt::format("{}-{}.html", attempt.exercise.id,
                  attempt.trainee.empty() ? "attempt" : attempt.trainee));
}

}  // namespace arthro::app
