// arthroscene replay SCENE TRACE.csv -o forces.csv [--report r.json]
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/living_tissues_of.h"
#include "app/cli/options_cli.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/session/replay.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct ReplayJob {
  fs::path scene, trace, forces, report;
  simulation::SessionOptions options;
};

bool IsSameFile(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

void Run(const ReplayJob& job) {
  CheckOptions(job.options);
  for (const fs::path& output : {job.forces, job.report})
    if (IsSameFile(output, job.trace))
      throw Error(Code::kBadArgument, "the trace itself cannot be the output; name another file",
                  output);
  const std::vector<simulation::TraceRow> trace = simulation::ReadTrace(job.trace);
  const LoadedScene loaded = LoadScene(job.scene);
  simulation::ReplayReport report;
  const auto rows = simulation::Replay(loaded, trace, job.options, TerminalProgress(), &report,
                                       LivingTissuesOf(loaded));
  WriteAtomically(job.forces, simulation::ForcesText(rows, loaded.scene));
  if (!job.report.empty())
    WriteAtomically(job.report, simulation::ReportText(report, loaded.scene));
}

}  // namespace

void AddReplayJob(CLI::App& program) {
  auto job = std::make_shared<ReplayJob>();
  CLI::App* command = program.add_subcommand(
      "replay", "Play recorded hands in a scene, on a fixed clock, and write the forces");
  command->add_option("SCENE", job->scene, "Scene folder or scene.json")->required();
  command->add_option("TRACE", job->trace, "Recorded devices, TRACE.csv")->required();
  command->add_option("-o,--output", job->forces, "forces.csv; - writes to standard output")
      ->required();
  command->add_option("--report", job->report, "Report as JSON: peaks, contacts, faults, times");
  AddOptions(*command, job->options, "Force");
  command->callback([job] { Run(*job); });
}

}  // namespace arthro::app
