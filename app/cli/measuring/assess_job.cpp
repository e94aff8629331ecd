// arthroscene assess SCENE TRACE -o metrics.csv [method.md, Metrics]: how a recorded attempt was
// done, as numbers.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/shipped_presets.h"
#include "simulation/core/atomic_file.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/training/assessment.h"
#include "simulation/training/attempt_log.h"

namespace arthro::app {
namespace {

struct AssessJob {
  std::filesystem::path scene, trace, output, report;
  simulation::SessionOptions options;
  simulation::MetricLimits limits;
};

void Run(const AssessJob& job) {
  CheckOptions(job.options);
  const LoadedScene loaded = LoadScene(job.scene);
  std::vector<std::string> messages;
  simulation::Assessment assessment;
  const std::string bytes = ReadWholeFile(job.trace);
  const auto log = simulation::IsDeviceLog(bytes) ? simulation::ParseDeviceLog(bytes, job.trace)
                                                  : simulation::DeviceLogContent();
  if (simulation::IsAttempt(log)) {
    const simulation::RecordedAttempt attempt = simulation::AttemptOf(log, job.trace);
    if (!attempt.torn.empty())
      fmt::print(stderr, "warning: {}: {}\n", job.trace.string(), attempt.torn);
    assessment = simulation::AssessFrames(attempt.frames, loaded.scene, job.limits);
  } else {
    std::string notice;
    const simulation::Recording recording = simulation::ReadRecording(job.trace, notice);
    if (!notice.empty()) fmt::print(stderr, "warning: {}\n", notice);
    assessment = simulation::Assess(loaded, recording, job.options, job.limits, TerminalProgress(),
                                    ShippedTissuePresets(), &messages);
  }
  for (const std::string& message : messages)
    fmt::print(stderr, "note: {}\n", PrintableLine(message));
  // How a person worked is for that person.
  WriteAtomically(job.output, simulation::AssessmentTable(assessment), Access::kPrivate);
  if (!job.report.empty())
    WriteAtomically(job.report, simulation::AssessmentReport(assessment, loaded.scene.title),
                    Access::kPrivate);
}

}  // namespace

void AddAssessJob(CLI::App& program) {
  const auto own = std::make_shared<AssessJob>();
  CLI::App* job = program.add_subcommand(
      "assess", "Measure how recorded hands worked in a scene: paths, smoothness, forces.");
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("SCENE", own->scene, "Scene folder, scene.json or .arthro archive."),
              kSceneInput)
      ->required();
  files
      ->Input(
          job->add_option("TRACE", own->trace,
                          "Recorded devices: TRACE.csv or a device log; or a recorded attempt, of "
                          "which nothing is simulated again."))
      ->required();
  files
      ->Output(job->add_option("-o,--output", own->output,
                               "Table to write, one metric a line; - is standard output."),
               {"a table of metrics", FileForm::kTable, "metric,part,value,"})
      ->required();
  files->Output(job->add_option("--report", own->report,
                                "Report as JSON, with what each metric means; - is standard "
                                "output."),
                {"a report", FileForm::kJson, "arthroscene.assessment/"});
  AddNumber(*job, "--harm-force", own->limits.harm, {0.1, 100.0}, "N",
            "Force above which an instrument may do harm.");
  AddOptions(*job, own->options);
  files->Run([own] { Run(*own); });
}

}  // namespace arthro::app
