// arthroscene bench panorama: speed and error side by side, on clips whose truth is known.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/registration_bench.h"
#include "app/bench/stitcher_peer.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/options_cli.h"
#include "simulation/core/atomic_file.h"

namespace arthro::app {
namespace {

struct PanoramaBenchJob {
  std::string json, plot;
  RegistrationBenchOptions options;
};

void Run(const PanoramaBenchJob& job) {
  if (job.json == "-" && job.plot == "-")
    throw Error(Code::kBadArgument,
                "table and plot cannot both go to standard output; give one of them a file");
  const RegistrationBench bench = RunRegistrationBench(job.options, TerminalProgress());
  if (!job.json.empty()) WriteAtomically(job.json, JsonOf(bench).dump(2) + "\n");
  if (!job.plot.empty()) WriteAtomically(job.plot, PlotOf(bench));
  if (job.json != "-" && job.plot != "-") fmt::print("{}", TableOf(bench));
}

// The other half of the peer: OpenCV's stitcher in a process of its own.
void AddWorker(CLI::App& program) {
  struct Arguments {
    std::string folder, mode;
    double cpu_limit = 0, memory_limit = 0;
  };
  CLI::App* worker = program.add_subcommand("stitcher-worker", "Started by bench.");
  worker->group("");  // not in the help
  const auto own = std::make_shared<Arguments>();
  worker->add_option("FOLDER", own->folder)->required();
  worker->add_option("MODE", own->mode)->required();
  worker->add_option("SECONDS", own->cpu_limit)->required();
  worker->add_option("BYTES", own->memory_limit)->required();
  worker->callback([own] {
    std::_Exit(RunStitcherWorker(own->folder,
                                 own->mode == "scans" ? PeerMode::kScans : PeerMode::kPanorama,
                                 own->cpu_limit, own->memory_limit));
  });
}

}  // namespace

void AddBenchJob(CLI::App& program) {
  CLI::App* bench = program.add_subcommand(
      "bench", "Measure speed and error side by side, on inputs whose truth is known.");
  bench->require_subcommand(1);
  CLI::App* panorama = bench->add_subcommand(
      "panorama",
      "Registration: detector, scale and stages against truth, beside OpenCV's stitcher.");
  const auto own = std::make_shared<PanoramaBenchJob>();
  panorama->add_option("--json", own->json, "Write the rows as JSON; - for standard output");
  panorama->add_option("--plot", own->plot, "Write an SVG of error over time");
  AddOptions(*panorama, own->options);
  panorama->callback([own] { Run(*own); });
  AddWorker(program);
}

}  // namespace arthro::app
