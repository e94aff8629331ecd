// arthroscene replay SCENE TRACE -o forces.csv [--report r.json]
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/living_tissues_of.h"
#include "app/cli/options_cli.h"
#include "app/cli/output_check.h"
#include "app/cli/replay_pictures.h"
#include "simulation/core/atomic_file.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/scene/scene_io.h"
#include "simulation/session/replay.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct ReplayJob {
  fs::path scene, trace, forces, report;
  simulation::SessionOptions options;
  fs::path pictures;
  int size = 512;
  double rate = 30.0;  // a second
};

// What a replay reads of a scene.
std::vector<fs::path> FilesOf(const LoadedScene& loaded) {
  std::vector<fs::path> files{SceneFile(loaded.folder)};
  const auto add = [&](const fs::path& name) {
    if (!name.empty()) files.push_back(loaded.folder / name);
  };
  const Scene& scene = loaded.scene;
  add(scene.backdrop.panorama);
  add(scene.backdrop.depth);
  add(scene.scope.lens);
  for (const Tissue& tissue : scene.tissues) {
    add(tissue.surface);
    add(tissue.mesh);
  }
  return files;
}

void Run(const ReplayJob& job) {
  CheckOptions(job.options);
  CheckOutputs({job.forces, job.report}, {job.trace, job.scene});
  if (!job.pictures.empty()) CheckOutputFolder(job.pictures, {job.forces, job.report});
  std::string notice;
  const std::vector<simulation::TraceRow> trace = simulation::ReadTraceOrLog(job.trace, notice);
  if (!notice.empty()) fmt::print(stderr, "warning: {}\n", notice);
  const LoadedScene loaded = LoadScene(job.scene);
  CheckOutputs({job.forces, job.report}, FilesOf(loaded));
  std::optional<ReplayPictures> pictures;
  simulation::ReplayWatch watch;
  if (!job.pictures.empty()) {
    pictures.emplace(loaded, job.pictures, job.size, job.rate);
    watch = [&](double t, const auto& snapshot, auto kind, const auto* world) {
      pictures->Watch(t, snapshot, kind, world);
    };
  }
  simulation::ReplayReport report;
  const auto rows = simulation::Replay(loaded, trace, job.options, TerminalProgress(), &report,
                                       LivingTissuesOf(loaded), LayersOf(loaded), watch);
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
  command->add_option("TRACE", job->trace, "Recorded devices: TRACE.csv or a device log")
      ->required();
  command->add_option("-o,--output", job->forces, "forces.csv; - writes to standard output")
      ->required();
  command->add_option("--report", job->report, "Report as JSON: peaks, contacts, faults, times");
  command->add_option("--pictures", job->pictures,
                      "Folder for what the scope saw: frame_00000.png and on");
  command->add_option("--size", job->size, "Width and height of a picture, px")
      ->check(CLI::Range(StillPictures::kMinSize, StillPictures::kMaxSize))
      ->capture_default_str();
  command->add_option("--rate", job->rate, "Pictures a second")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  AddOptions(*command, job->options, "Force");
  command->callback([job] { Run(*job); });
}

}  // namespace arthro::app
