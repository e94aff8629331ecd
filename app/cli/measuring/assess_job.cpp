// arthroscene assess SCENE ATTEMPT [--exercise ID] [method.md, Score]: how an attempt
// was done. With an exercise: its steps, criteria and metrics, as while it ran; without: numbers of
// the recorded hands alone.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/about/about.h"
#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/shipped_presets.h"
#include "app/cli/records/records_job.h"
#include "app/records/keeping/expert_attempt.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/report/assessment_file.h"
#include "app/report/attempt_words.h"
#include "app/report/draw_pictures.h"
#include "app/report/make_report.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/scene/exercise/find_exercise.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/training/assessment.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/observed_recording.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct AssessJob {
  fs::path scene, attempt, table, csv, page, json;
  std::string exercise, group;
  std::shared_ptr<RecordsPlace> place;
  bool observes_anew = false, requires_pass = false, leaves_pictures = false;
  simulation::SessionOptions options;
  simulation::MetricLimits limits;
};

void Note(const std::string& kind, const std::string& sentence) {
  fmt::print(stderr, "{}: {}\n", kind, PrintableLine(sentence));
}

// Records of the reference group; null without one.
std::unique_ptr<Records> GroupRecords(const AssessJob& job) {
  return job.group.empty() ? nullptr : std::make_unique<Records>(job.place->Connection());
}

simulation::Recording HandsOf(const AssessJob& job) {
  std::string notice;
  simulation::Recording recording = simulation::ReadRecording(job.attempt, notice);
  if (!notice.empty()) Note("warning", job.attempt.string() + ": " + notice);
  return recording;
}

// Marks and answers are acts of a trainee, which a recording of hands does not have.
void NoteMissingActs(const Exercise& exercise) {
  for (const ExerciseStep& step : exercise.steps)
    if (std::holds_alternative<MeasureStep>(step) || std::holds_alternative<AnswerStep>(step))
      Note("note", fmt::format("step {} cannot be done: recorded hands have no marks and no "
                               "answers; record an attempt at the exercise",
                               BaseOf(step).id));
}

// Frames and events of the attempt, which is at this exercise. `head`: empty for recorded hands.
simulation::RecordedAttempt Observed(const AssessJob& job, const LoadedScene& loaded,
                                     const Exercise& exercise, const std::string& bytes,
                                     simulation::AttemptHead& head) {
  simulation::RecordedAttempt attempt;
  const auto log = simulation::IsDeviceLog(bytes) ? simulation::ParseDeviceLog(bytes, job.attempt)
                                                  : simulation::DeviceLogContent();
  if (!simulation::IsAttempt(log)) {
    NoteMissingActs(exercise);
    std::vector<std::string> messages;
    attempt.frames =
        simulation::ObserveRecording(loaded, HandsOf(job), exercise, job.options,
                                     TerminalProgress(), ShippedTissuePresets(), &messages);
    for (const std::string& message : messages) Note("note", message);
    return attempt;
  }
  attempt = simulation::AttemptOf(log, job.attempt);
  if (!attempt.torn.empty()) Note("warning", job.attempt.string() + ": " + attempt.torn);
  if (!attempt.track_fault.empty())
    Note("warning", job.attempt.string() + ": " + attempt.track_fault);
  head = simulation::AttemptHeadOf(attempt.head, job.attempt);
  if (job.observes_anew)
    simulation::ObserveAnew(loaded, exercise, attempt.frames);
  else if (const std::string why = simulation::WhyAnotherScene(head, loaded, exercise);
           !why.empty())
    throw Error(Code::kBadArgument, why, job.attempt);
  return attempt;
}

AttemptReport AssessExercise(const AssessJob& job, const LoadedScene& loaded,
                             const std::string& bytes) {
  const Exercise& exercise = ExerciseWithId(loaded.scene.exercises, job.exercise);
  simulation::AttemptHead head;
  simulation::RecordedAttempt attempt = Observed(job, loaded, exercise, bytes, head);
  const auto records = GroupRecords(job);
  const std::string hash = ExerciseRowOf(exercise).hash;
  const simulation::AttemptResult result = ResultBesideGhost(
      loaded, exercise, attempt,
      records ? GroupValuesOf(*records, hash, head.rig) : std::vector<simulation::GroupValues>(),
      job.limits);
  AttemptReport report = MakeReport(exercise, result, std::move(attempt.frames));
  report.track = std::move(attempt.track);
  report.attempt.id = head.attempt;
  report.attempt.scene = loaded.scene.title;
  report.attempt.started = head.started;
  report.is_mode_known = !head.mode.empty();
  for (const auto& [mode, word] : AttemptModes().words)
    if (word == head.mode) report.attempt.mode = mode;
  report.rig = head.rig;
  report.program = head.program;
  if (records) SetGroup(report, *records, job.group);
  try {
    SetExpert(report, loaded, exercise, records.get());
  } catch (const Error& fault) {
    Note("note", fmt::format("the expert's attempt is left out: {}", fault.what()));
  }
  return report;
}

// A report without pictures is one as well.
void DrawPictures(const LoadedScene& loaded, AttemptReport& report) {
  if (const std::string why = SetPictures(report, loaded, ShippedLooks(loaded.scene)); !why.empty())
    Note("note", fmt::format("the report has no pictures: {}", why));
}

AttemptReport AssessHands(const AssessJob& job, const LoadedScene& loaded,
                          const std::string& bytes) {
  std::vector<std::string> messages;
  const auto log = simulation::IsDeviceLog(bytes) ? simulation::ParseDeviceLog(bytes, job.attempt)
                                                  : simulation::DeviceLogContent();
  simulation::Assessment assessment;
  if (simulation::IsAttempt(log)) {
    const simulation::RecordedAttempt attempt = simulation::AttemptOf(log, job.attempt);
    if (!attempt.torn.empty()) Note("warning", job.attempt.string() + ": " + attempt.torn);
    assessment = simulation::AssessFrames(attempt.frames, loaded.scene, job.limits);
  } else {
    assessment = simulation::Assess(loaded, HandsOf(job), job.options, job.limits,
                                    TerminalProgress(), ShippedTissuePresets(), &messages);
  }
  for (const std::string& message : messages) Note("note", message);
  simulation::AttemptResult result;
  result.duration = assessment.duration;
  result.metrics = std::move(assessment.values);
  AttemptReport report = MakeReport({}, result, std::move(assessment.frames));
  report.exercise = {};
  report.attempt.scene = loaded.scene.title;
  return report;
}

// Names the two inputs where they are given in the wrong order.
void CheckOrder(const AssessJob& job) {
  std::string start(16, '\0');  // enough to tell a log
  std::error_code unreadable;
  const bool is_file = fs::is_regular_file(job.scene, unreadable);
  if (is_file) std::ifstream(job.scene, std::ios::binary).read(start.data(), std::ssize(start));
  if (simulation::IsDeviceLog(start))
    throw Error(Code::kBadArgument, "this is an attempt or recorded hands; give the scene first",
                job.scene);
  if (fs::is_directory(job.attempt, unreadable))
    throw Error(Code::kBadArgument, "this is a folder and no attempt; give the scene first",
                job.attempt);
}

void Run(const AssessJob& job) {
  CheckOptions(job.options);
  CheckOrder(job);
  if (job.exercise.empty() && (job.requires_pass || job.observes_anew || !job.group.empty()))
    throw Error(Code::kBadArgument,
                "--require-pass, --reobserve and --reference are about an exercise; give "
                "--exercise ID");
  const fs::path& table = job.csv.empty() ? job.table : job.csv;
  if (table.empty() && job.page.empty() && job.json.empty() && !job.requires_pass)
    throw Error(Code::kBadArgument, "nothing is to be written; give --csv, --report or --json");
  const LoadedScene loaded = LoadScene(job.scene);
  const std::string bytes = ReadWholeFile(job.attempt);
  AttemptReport report =
      job.exercise.empty() ? AssessHands(job, loaded, bytes) : AssessExercise(job, loaded, bytes);
  if (report.program.empty()) report.program = fmt::format("arthroscene {}", Version());
  if (!job.page.empty() && !job.leaves_pictures) DrawPictures(loaded, report);
  // How a person worked is for that person.
  if (!table.empty()) WriteAtomically(table, MetricTable(report), Access::kPrivate);
  if (!job.page.empty()) WriteAtomically(job.page, AttemptPage(report), Access::kPrivate);
  if (!job.json.empty()) WriteAtomically(job.json, AttemptJson(report), Access::kPrivate);
  if (job.requires_pass && report.attempt.outcome != AttemptOutcome::kPassed)
    throw Error(Code::kBadData,
                fmt::format("the attempt is not passed, as --require-pass asks for: {}",
                            OutcomeWords(report.attempt)),
                job.attempt);
}

}  // namespace

void AddAssessJob(CLI::App& program) {
  const auto own = std::make_shared<AssessJob>();
  CLI::App* job = program.add_subcommand(
      "assess",
      "Assess an attempt at an exercise, or measure how recorded hands worked in a scene.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", own->scene, "Scene folder, scene.json or .arthro archive."),
              kSceneInput)
      ->required();
  files
      ->Input(job->add_option(
          "ATTEMPT", own->attempt,
          "Attempt of the records (.attempt), whose frames are used as they are; or recorded hands "
          "(the log of a practice, TRACE.csv), which are replayed and observed."))
      ->required();
  job->add_option("--exercise", own->exercise,
                  "Exercise of the scene by whose steps and criteria the attempt is judged. "
                  "Without it, hands are measured.")
      ->type_name("ID");
  const FileKind table{"a table of metrics", FileForm::kTable, kMetricTableHead};
  files->Output(job->add_option("-o,--output", own->table,
                                "Table to write, one metric a line; - is standard output."),
                table);
  files
      ->Output(job->add_option("--csv", own->csv, "The same table, as the other reports name it."),
               table)
      ->excludes("--output");
  files->Output(job->add_option("--report", own->page, "Page to write (HTML), for A4."),
                {"a page", FileForm::kTable, kAttemptPageHead});
  files->Output(job->add_option("--json", own->json, "Report as JSON; - is standard output."),
                {"a report", FileForm::kJson, "arthroscene.assessment/"});
  job->add_flag("--no-pictures", own->leaves_pictures,
                "Leave pictures of the scope off the page. They need OpenGL, in software too.");
  job->add_option("--reference", own->group,
                  "Reference group of the records: its limits hold, and the report shows its "
                  "values.")
      ->type_name("GROUP");
  own->place = AddPlace(*job);
  job->add_flag("--reobserve", own->observes_anew,
                "See the targets of an attempt anew, in a scene or at an exercise that has changed "
                "since. Tissue is then as at the begin of a session.");
  job->add_flag("--require-pass", own->requires_pass,
                "Exit with 1 for an attempt that is not passed; the files are written all the "
                "same.");
  AddNumber(*job, "--harm-force", own->limits.harm, {0.1, 100.0}, "N",
            "Force above which an instrument may do harm.");
  AddOptions(*job, own->options);
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
