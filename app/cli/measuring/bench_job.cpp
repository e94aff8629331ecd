// arthroscene bench panorama, tissue, haptics, view: speed and error side by side, on inputs whose
// truth is known.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/haptics/haptics_bench.h"
#include "app/bench/panorama/registration_bench.h"
#include "app/bench/panorama/stitcher_peer.h"
#include "app/bench/tissue/tissue_bench.h"
#include "app/bench/view/view_bench.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/number_flags.h"
#include "app/cli/options_cli.h"
#include "simulation/core/atomic_file.h"

namespace arthro::app {
namespace {

template <class Options>
struct BenchArguments {
  std::string json, plot;
  Options options;
};

// `measure`: options and progress to a bench that has TableOf, JsonOf and PlotOf.
template <class Options, class Measure>
void Run(const BenchArguments<Options>& job, Measure measure) {
  if (job.json == "-" && job.plot == "-")
    throw Error(Code::kBadArgument,
                "table and plot cannot both go to standard output; give one of them a file");
  const auto bench = measure(job.options, TerminalProgress());
  if (!job.json.empty()) WriteAtomically(job.json, JsonOf(bench).dump(2) + "\n");
  if (!job.plot.empty()) WriteAtomically(job.plot, PlotOf(bench));
  if (job.json != "-" && job.plot != "-") fmt::print("{}", TableOf(bench));
}

template <class Options, class Measure>
void AddBench(CLI::App& bench, const char* name, const char* help, Measure measure) {
  CLI::App* job = bench.add_subcommand(name, help);
  const auto own = std::make_shared<BenchArguments<Options>>();
  const auto files = JobFiles::Of(*job);
  files->Output(
      job->add_option("--json", own->json, "Write the rows as JSON; - for standard output"),
      {"a table", FileForm::kJson, "arthroscene.bench."});
  files->Output(job->add_option("--plot", own->plot, "Write an SVG of error over time"), kPlotFile);
  AddOptions(*job, own->options);
  files->Run([own, measure] { Run(*own, measure); });
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
  AddNumber(*worker, "SECONDS", own->cpu_limit, {0.0, 1e6}, "s", "")->required();
  AddNumber(*worker, "BYTES", own->memory_limit, {0.0, 1e15}, "", "")->required();
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
  AddBench<RegistrationBenchOptions>(
      *bench, "panorama",
      "Registration: detector, scale and stages against truth, beside OpenCV's stitcher.",
      RunRegistrationBench);
  AddBench<TissueBenchOptions>(
      *bench, "tissue",
      "Deformable tissue: element, mesh, tolerance and law against continuum values.",
      RunTissueBench);
  AddBench<HapticsBenchOptions>(
      *bench, "haptics",
      "Touch: a servo tick's time by stages; force against closed forms, beside the paper's; where "
      "a wall begins to swing.",
      RunHapticsBench);
  AddBench<ViewBenchOptions>(
      *bench, "view",
      "The scope's picture: a frame's time by search, looks, sizes, tissue, lamp and disturbance; "
      "beside it how far the picture is from a ray tracer. No display is needed.",
      RunViewBench);
  AddWorker(program);
}

}  // namespace arthro::app
