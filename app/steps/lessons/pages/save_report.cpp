// The report of the attempt that is shown, as a page (HTML) with pictures of the scope.
#include <utility>

#include <fmt/format.h>

#include "app/report/draw_pictures.h"
#include "app/report/make_report.h"
#include "app/state/command.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/lessons_step.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

AttemptReport ReportOfShown(const EditorState& state, const FinishedAttempt& attempt) {
  const LessonRecords& records = *state.steps.lessons->records;
  if (!attempt.id.empty() && records.open) try {
      std::string notice;
      return ReportFromRecords(*records.open, attempt.id, notice);
    } catch (const Error&) {  // it waits in the outbox
    }
  AttemptReport report = MakeReport(attempt.exercise, attempt.result, attempt.frames);
  report.attempt.id = attempt.id;
  report.attempt.scene = state.document().scene.title;
  report.attempt.started = attempt.started;
  report.attempt.mode = attempt.is_robot  ? AttemptMode::kRobot
                        : attempt.is_test ? AttemptMode::kTest
                                          : AttemptMode::kPractice;
  report.is_mode_known = true;
  report.trainee = attempt.trainee;
  if (attempt.track) report.track = attempt.track->pieces();
  return report;
}

// Compares the attempt with the expert of the scene that is open; an expert that cannot be read is
// left out, since the look back says why.
void AddExpert(const EditorState& state, const FinishedAttempt& attempt, AttemptReport& report) {
  for (const Exercise& exercise : state.document().scene.exercises)
    if (exercise.id == attempt.exercise.id && ExerciseRowOf(exercise).hash == report.exercise.hash)
      try {
        SetExpert(report, state.document(), exercise, state.steps.lessons->records->open.get());
      } catch (const Error&) {
      }
}

// Draws in the thread of a job, in a context of its own, and writes the page after that.
void WriteReport(EditorState& state, const std::filesystem::path& file, AttemptReport report) {
  const bool is_of_scene = state.steps.lessons->finished->is_of_scene;
  state.jobs.Start(
      "Report",
      [file, report = std::move(report), is_of_scene, document = state.document(),
       looks = simulation::LooksOf(state.document().scene.tissues, state.tissue_presets)](
          const Progress&) -> Jobs::Apply {
        AttemptReport whole = report;
        const std::string notice =
            is_of_scene ? SetPictures(whole, document, looks) : std::string();
        return [file, notice, page = AttemptPage(whole)](EditorState& now) {
          WriteAtomically(file, page, Access::kPrivate);
          now.message = notice.empty() ? fmt::format("The report is in {}.", file.string())
                                       : fmt::format("The report is in {}. It has no pictures: {}",
                                                     file.string(), notice);
        };
      });
}

}  // namespace

void SaveReport(EditorState& state) {
  const FinishedAttempt& attempt = *state.steps.lessons->finished;
  Browse(
      state, BrowseFor::kSaveFile, "Save the report of this attempt", "Save",
      {{"Pages", {".html"}}},
      [](EditorState& now, const std::filesystem::path& file) {
        if (!now.steps.lessons->finished) return;
        Guarded(now, "Report", [&] {
          if (now.jobs.busy())
            throw Error(Code::kBadArgument,
                        "other work is under way; save the report when it has ended");
          const FinishedAttempt& shown = *now.steps.lessons->finished;
          AttemptReport report = ReportOfShown(now, shown);
          AddExpert(now, shown, report);
          WriteReport(now, file, std::move(report));
        });
      },
      fmt::format("{}-{}.html", attempt.exercise.id,
                  attempt.trainee.empty() ? "attempt" : attempt.trainee));
}

}  // namespace arthro::app
