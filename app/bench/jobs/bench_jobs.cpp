#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/haptics/haptics_bench.h"
#include "app/bench/micro/micro_bench.h"
#include "app/bench/panorama/registration_bench.h"
#include "app/bench/panorama/stitcher_peer.h"
#include "app/bench/relief/relief_bench.h"
#include "app/bench/report/bench_report.h"
#include "app/bench/tissue/tissue_bench.h"
#include "app/bench/view/look_bench.h"
#include "app/bench/view/view_bench.h"
#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "simulation/core/atomic_file.h"

namespace arthro::app {
namespace {

template <class Options>
struct BenchArguments {
  std::string json, plot;
  Options options;
};

// Files of a clip with known truth.
std::vector<std::filesystem::path> FilesOfClip(const std::filesystem::path& clip) {
  std::vector<std::filesystem::path> files;
  for (const char* name : {"lens.json", "gt.json", "radius.npy"}) files.push_back(clip / name);
  std::error_code fault;
  for (const auto& frame : std::filesystem::directory_iterator(clip / "frames", fault))
    files.push_back(frame.path());
  return files;
}
constexpr InputKind kClipInput{FilesOfClip, nullptr};

// `measure` makes from options and progress a bench that has TableOf, JsonOf and PlotOf.
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
      job->add_option("--json", own->json, "Write the rows as JSON; - for standard output."),
      {"a table", FileForm::kJson, "arthroscene.bench."});
  files->Output(job->add_option("--plot", own->plot, "Write an SVG of error over time."),
                kPlotFile);
  AddOptions(*job, own->options);
  if (CLI::Option* clip = job->get_option_no_throw("--clip")) files->Input(clip, kClipInput);
  files->Run([own, measure] { Run(*own, measure); });
}

// Speed and error of the view or, with --look, statistics of its pictures.
void AddViewBench(CLI::App& program) {
  struct Arguments {
    BenchArguments<ViewBenchOptions> bench;
    std::string look, frames;
  };
  CLI::App* job = program.add_subcommand(
      "view",
      "Arthroscopic picture: time of a frame by relief search, samples per pixel, size, tissue, "
      "lamp, camera and disturbance, and its difference from a ray tracer. No display is needed.");
  const auto own = std::make_shared<Arguments>();
  const auto files = JobFiles::Of(*job);
  files->Output(
      job->add_option("--json", own->bench.json, "Write the rows as JSON; - for standard output."),
      {"a table", FileForm::kJson, "arthroscene.bench."});
  CLI::Option* plot =
      job->add_option("--plot", own->bench.plot, "Write an SVG of error over time.");
  files->Output(plot, kPlotFile);
  CLI::Option* look = files->Input(
      job->add_option("--look", own->look,
                      "Scene of which the statistics of 24 pictures are printed instead: "
                      "percentiles of grey, clipped share, gradient, flat share, chroma."),
      kSceneInput);
  look->excludes(plot);
  files
      ->Input(job->add_option("--frames", own->frames,
                              "Folder of real frames, or a clip, measured beside the scene."),
              kFootageInput)
      ->needs(look);
  AddOptions(*job, own->bench.options);
  files->Run([own] {
    if (own->look.empty()) return Run(own->bench, RunViewBench);
    const LookBench bench = RunLookBench(own->look, own->frames, TerminalProgress());
    if (!own->bench.json.empty()) WriteAtomically(own->bench.json, JsonOf(bench).dump(2) + "\n");
    if (own->bench.json != "-") fmt::print("{}", TableOf(bench));
  });
}

// OpenCV's stitcher in a process of its own.
void AddWorker(CLI::App& program) {
  struct Arguments {
    std::string folder, mode;
    double cpu_limit = 0, memory_limit = 0;
  };
  CLI::App* worker =
      program.add_subcommand("stitcher-worker", "Runs OpenCV's stitcher for `panorama`.");
  worker->group("");  // hidden from the help
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

// Every benchmark in one report.
void AddAll(CLI::App& program) {
  struct Arguments {
    std::string folder;
    BenchAllOptions options;
  };
  CLI::App* job = program.add_subcommand(
      "all", "Every benchmark, as one page: report.html, report.json and each plot as SVG.");
  const auto own = std::make_shared<Arguments>();
  const auto files = JobFiles::Of(*job);
  files
      ->OutputFolder(job->add_option("-o,--output", own->folder, "Folder for the report."),
                     {{"report[.]html", {"a report", FileForm::kTable, kReportHead}},
                      {"report[.]json", {"a report", FileForm::kJson, "arthroscene.bench.all/"}},
                      {"(panorama|relief|tissue|haptics|view|micro-[a-z]+)[.]svg", kPlotFile}})
      ->required();
  AddOptions(*job, own->options);
  files->Run([own] {
    WriteReport(RunEveryBench(own->options, TerminalProgress()), own->folder);
    fmt::print("{}\n", (std::filesystem::path(own->folder) / "report.html").string());
  });
}

}  // namespace

void AddBenches(CLI::App& program) {
  AddBench<RegistrationBenchOptions>(
      program, "panorama",
      "Registration: detector, scale and stages against truth, beside OpenCV's stitcher.",
      RunRegistrationBench);
  AddBench<ReliefBenchOptions>(
      program, "relief",
      "Relief: measured from the motion of the scope and estimated from brightness, against the "
      "true surface, with the force over each.",
      RunReliefBench);
  AddBench<TissueBenchOptions>(
      program, "tissue",
      "Deformable tissue: element, mesh, tolerance and law against continuum values.",
      RunTissueBench);
  AddBench<HapticsBenchOptions>(
      program, "haptics",
      "Touch: time of a servo tick by stage, force against closed forms and beside the paper's "
      "kernel, stiffness at which a wall becomes unstable.",
      RunHapticsBench);
  AddViewBench(program);
  AddBench<MicroBenchOptions>(
      program, "micro",
      "Single functions of scope, lens, depth, composition, surfaces and tissue, each with its "
      "error.",
      RunMicroBench);
  AddAll(program);
  AddWorker(program);
}

}  // namespace arthro::app
