#include <chrono>
#include <ctime>
#include <sys/utsname.h>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "app/bench/haptics/haptics_bench.h"
#include "app/bench/machine_words.h"
#include "app/bench/micro/micro_bench.h"
#include "app/bench/panorama/registration_bench.h"
#include "app/bench/relief/relief_bench.h"
#include "app/bench/report/bench_report.h"
#include "app/bench/tissue/tissue_bench.h"
#include "app/bench/view/view_bench.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

std::string SystemWords() {
  utsname name{};
  uname(&name);
  double load[1] = {0};
  const bool has_load = getloadavg(load, 1) == 1;
  return fmt::format(
      "{} {} {}{}", name.sysname, name.release, name.machine,
      has_load ? fmt::format(", load average {:.1f} before the first benchmark", load[0]) : "");
}

template <class Bench>
std::vector<BenchPlot> PlotsOf(const char* name, const Bench& bench) {
  return {{name, PlotOf(bench)}};
}

std::vector<BenchPlot> PlotsOf(const char* name, const MicroBench& bench) {
  std::vector<BenchPlot> plots;
  for (const MicroGroup& group : bench.groups)
    if (std::string svg = PlotOf(bench, group); !svg.empty())
      plots.push_back({fmt::format("{}-{}", name, group.name), std::move(svg)});
  return plots;
}

template <class Options, class Measure>
void AddSection(BenchReport& report, const char* name, const char* title, const Options& options,
                Measure measure, const Progress& progress) {
  BenchSection section{name, title, {}, {}, {}, {}};
  try {
    const auto bench = measure(options, progress);
    section.table = TableOf(bench);
    section.json = JsonOf(bench);
    section.plots = PlotsOf(name, bench);
  } catch (const Error& fault) {
    if (fault.code() != Code::kDisplay) throw;
    section.fault = fault.what();
  }
  report.sections.push_back(std::move(section));
}

}  // namespace

BenchReport RunEveryBench(const BenchAllOptions& options, const Progress& progress) {
  RegistrationBenchOptions panorama;
  ReliefBenchOptions relief;
  TissueBenchOptions tissue;
  HapticsBenchOptions haptics;
  ViewBenchOptions view;
  MicroBenchOptions micro;
  if (options.quick) {
    panorama.frames = 3;
    panorama.width = 200;
    panorama.height = 160;
    panorama.peer_limit = 5;
    relief.quick = true;
    relief.touches = 50;
    tissue.only = "meniscus";
    tissue.max_elements = 600;
    tissue.frames = 30;
    haptics = {500, 1, 50, 50};
    view = {3, 256, 1024, 5000, 1000};
    micro.quick = true;
  }
  BenchReport report;
  report.machine = MachineWords();
  report.system = SystemWords();
  report.date = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
  report.quick = options.quick;
  const auto start = std::chrono::steady_clock::now();
  AddSection(report, "panorama", "Registration of video frames", panorama, RunRegistrationBench,
             progress);
  AddSection(report, "relief", "Relief of the tissue", relief, RunReliefBench, progress);
  AddSection(report, "tissue", "Deformable tissue", tissue, RunTissueBench, progress);
  AddSection(report, "haptics", "Touch", haptics, RunHapticsBench, progress);
  AddSection(report, "view", "Arthroscopic view", view, RunViewBench, progress);
  AddSection(report, "micro", "Single functions", micro, RunMicroBench, progress);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace arthro::app
