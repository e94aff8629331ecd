// arthroscene robot SCENE --exercise ID [method.md, Robots]: an attempt at an exercise by a
// scripted expert, or by a novice with a planted fault, as a file that `assess` judges.
#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/about/about.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/shipped_presets.h"
#include "app/cli/records/records_job.h"
#include "app/records/attempts/attempt_record.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/records/people/trainees.h"
#include "app/records/store/records.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/exercise/find_exercise.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/attempt_head.h"
#include "simulation/training/observe/surface_names.h"
#include "simulation/training/robot/robot.h"
#include "simulation/training/scene_of_attempt.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using simulation::RobotFault;

struct RobotJob {
  fs::path scene, attempt;
  std::string exercise, fault = "none", trainee;
  std::shared_ptr<RecordsPlace> place;
  simulation::RobotOptions options;
  bool requires_pass = false;
};

std::vector<std::string> FaultWords() {
  std::vector<std::string> words;
  words.reserve(simulation::kRobotFaults);
  for (int i = 0; i < simulation::kRobotFaults; ++i)
    words.emplace_back(ToString(static_cast<RobotFault>(i)));
  return words;
}

// The time of the begin is that of the epoch and the id comes from the seed: the same robot leaves
// the same bytes.
simulation::AttemptHead HeadOf(const RobotJob& job, const LoadedScene& loaded,
                               const Exercise& exercise) {
  Random random(static_cast<std::uint64_t>(job.options.seed));
  return {.attempt = UuidOf(random),
          .exercise = exercise.id,
          .exercise_hash = HashOf(exercise),
          .scene = loaded.scene.title,
          .scene_fingerprint = simulation::FingerprintOfScene(loaded),
          .mode = ToString(AttemptMode::kRobot),
          .rig = "robot",
          .started = UtcText(0),
          .program = fmt::format("arthroscene {}", Version()),
          .surfaces = simulation::SurfaceNames(loaded.scene)};
}

// Keeps the attempt in the records, in mode robot.
void Keep(const RobotJob& job, const LoadedScene& loaded, const Exercise& exercise,
          const fs::path& file, const simulation::AttemptResult& result, Records& records) {
  const std::string program = fmt::format("arthroscene {}", Version());
  const SessionRow session = StartSession(records, job.trainee, program, "robot");
  KeptAttempt kept(&records, records.folder(), session,
                   {.trainee = job.trainee,
                    .exercise = ExerciseRowOf(exercise),
                    .scene = loaded.scene.title,
                    .scene_fingerprint = simulation::FingerprintOfScene(loaded),
                    .surfaces = simulation::SurfaceNames(loaded.scene),
                    .mode = AttemptMode::kRobot,
                    .program = program,
                    .rig = "robot"});
  const simulation::RecordedAttempt attempt = simulation::ReadAttempt(file);
  kept.Add(attempt.frames, attempt.events, attempt.track);
  const std::string where = kept.Finish(&records, result);
  EndSession(records, session.id);
  for (const std::string& notice : kept.notices())
    fmt::print(stderr, "warning: {}\n", PrintableLine(notice));
  fmt::print("Kept for {} as attempt {}.\n", job.trainee, kept.record().id);
  if (!where.empty()) fmt::print(stderr, "note: {}\n", PrintableLine(where));
}

void Print(const simulation::AttemptResult& result) {
  fmt::print("{} after {:.2f} s{}{}\n", ToString(result.outcome), result.duration,
             result.reason.empty() ? "" : ": ", PrintableLine(result.reason));
  for (const simulation::CriterionResult& criterion : result.criteria)
    fmt::print("{:8} {}\n", criterion.is_met ? "met" : "not met",
               simulation::CriterionWords(criterion));
}

void Run(const RobotJob& job) {
  CheckOptions(job.options);
  const LoadedScene loaded = LoadScene(job.scene);
  const Exercise& exercise = ExerciseWithId(loaded.scene.exercises, job.exercise);
  simulation::RobotOptions options = job.options;
  options.fault = *simulation::RobotFaultFromString(job.fault);
  std::unique_ptr<Records> records;
  if (!job.trainee.empty()) {
    records = std::make_unique<Records>(job.place->Connection());
    FindTrainee(*records, job.trainee);
  }
  std::unique_ptr<PartialFile> partial;
  std::unique_ptr<simulation::AttemptLog> log;
  // The log of an attempt that is kept lies beside the records for as long as the robot is at work.
  const fs::path file =
      job.attempt.empty() && records
          ? records->folder() / fmt::format("robot-{}.attempt", static_cast<long>(::getpid()))
          : job.attempt;
  if (!file.empty()) {
    partial = std::make_unique<PartialFile>(file, Access::kPrivate);
    log = std::make_unique<simulation::AttemptLog>(
        partial->beside(), std::vector<simulation::LogSource>{{"", "", "1", {}}},
        simulation::AttemptHeadText(HeadOf(job, loaded, exercise)));
  }
  const simulation::RobotRun run =
      simulation::RunRobot(loaded, exercise, ShippedTissuePresets(), options, log.get());
  if (log) {
    log->Close();
    if (!job.attempt.empty()) partial->PutInPlace();
  }
  for (const std::string& trouble : run.troubles)
    fmt::print(stderr, "note: {}\n", PrintableLine(trouble));
  Print(run.result);
  if (records)
    Keep(job, loaded, exercise, job.attempt.empty() ? partial->beside() : job.attempt, run.result,
         *records);
  if (options.fault != RobotFault::kNone && run.result.outcome == AttemptOutcome::kPassed)
    fmt::print(stderr, "note: no criterion of {} shows the fault {}\n", exercise.id, job.fault);
  if (job.requires_pass && run.result.outcome != AttemptOutcome::kPassed)
    throw Error(
        Code::kBadData,
        fmt::format("the robot did not pass, as --require-pass asks for: {}",
                    run.result.reason.empty() ? "a criterion is not met" : run.result.reason));
}

}  // namespace

void AddRobotJob(CLI::App& program) {
  const auto own = std::make_shared<RobotJob>();
  CLI::App* job = program.add_subcommand(
      "robot", "Let a scripted expert or novice make an attempt at an exercise, without a window.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", own->scene, "Scene folder, scene.json or .arthro archive."),
              kSceneInput)
      ->required();
  job->add_option("--exercise", own->exercise, "Exercise of the scene.")
      ->required()
      ->type_name("ID");
  files->Output(job->add_option("-o,--output", own->attempt,
                                "Attempt to write (.attempt), which `assess` judges. Default: the "
                                "result is printed only."),
                {"an attempt", FileForm::kUnique});
  CLI::Option* trainee =
      job->add_option("--trainee", own->trainee,
                      "Code under which the records keep the attempt, in mode robot: such attempts "
                      "open no gate, and stand in no group of trainees.")
          ->type_name("CODE");
  own->place = AddPlace(*job);
  job->get_option("--records")->needs(trainee);
  job->add_option("--fault", own->fault, "Fault that a novice plants; none for an expert.")
      ->check(CLI::IsMember(FaultWords()))
      ->capture_default_str();
  job->add_flag("--require-pass", own->requires_pass,
                "Exit with 1 where the robot does not pass; the attempt is written all the same.");
  AddOptions(*job, own->options);
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
