#include "app/bench/micro/micro_bench.h"

#include <cmath>
#include <exception>
#include <map>
#include <utility>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/machine_words.h"
#include "app/bench/quantile.h"
#include "app/bench/speed_error_plot.h"
#include "simulation/core/error.h"
#include "simulation/core/options_json.h"

namespace arthro::app {
namespace {

// Keeps each repetition's time per call.
class SampleReporter final : public benchmark::BenchmarkReporter {
 public:
  struct Samples {
    std::vector<double> wall, cpu;  // s
  };
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const double scale = 1 / benchmark::GetTimeUnitMultiplier(run.time_unit);
      Samples& samples = samples_[run.run_name.function_name];
      samples.wall.push_back(scale * run.GetAdjustedRealTime());
      samples.cpu.push_back(scale * run.GetAdjustedCPUTime());
    }
  }
  const Samples& At(const std::string& name) const { return samples_.at(name); }

 private:
  std::map<std::string, Samples> samples_;
};

std::string FullName(const MicroGroup& group, const MicroFunction& function) {
  return group.name + "/" + function.name;
}

std::string TimeText(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  Unit unit{1e-9, "ns"};
  for (const Unit larger : {Unit{1e-6, "us"}, Unit{1e-3, "ms"}, Unit{1.0, "s"}})
    if (seconds >= larger.seconds) unit = larger;
  return fmt::format("{:.3g} {}", seconds / unit.seconds, unit.name);
}

}  // namespace

MicroBench RunMicroBench(const MicroBenchOptions& options, const Progress& progress) {
  MicroBench bench{options, {}, {}};
  std::string names;
  for (MicroGroup (*const make)(bool) :
       {AlignmentMicro, ScopeMicro, LensMicro, DepthMicro, PreviewMicro, ComposeMicro, SolidMicro,
        SurfaceMicro, ReachMicro, KernelMicro, ObserverMicro, BrushMicro, MurkMicro}) {
    MicroGroup group = make(options.quick);
    names += (names.empty() ? "" : ", ") + group.name;
    if (group.name.starts_with(options.only)) bench.groups.push_back(std::move(group));
  }
  if (bench.groups.empty())
    throw Error(Code::kBadArgument,
                fmt::format("there is no group \"{}\"; there are {}", options.only, names));

  std::size_t count = 0, done = 0;
  for (const MicroGroup& group : bench.groups) count += group.functions.size();
  std::exception_ptr fault;
  benchmark::ClearRegisteredBenchmarks();
  for (const MicroGroup& group : bench.groups)
    for (const MicroFunction& function : group.functions) {
      const std::string name = FullName(group, function);
      // Faults must not pass through Google Benchmark, which does not expect them.
      const auto run = [&, name, is_warm = std::make_shared<bool>(false)](benchmark::State& state) {
        try {
          if (!fault) progress.Step(name, static_cast<double>(done) / static_cast<double>(count));
          // The first call makes the function's input.
          if (!fault && !std::exchange(*is_warm, true)) {
            ++done;
            function.call();
          }
          for (auto _ : state) {
            if (!fault) function.call();
          }
        } catch (...) {
          fault = std::current_exception();
          state.SkipWithError("fault");
        }
      };
      auto* registered = benchmark::RegisterBenchmark(name.c_str(), run);
      registered->MeasureProcessCPUTime();
      registered->UseRealTime();
      registered->Repetitions(options.quick ? 1 : options.repetitions);
      registered->MinTime(options.quick ? 1e-4 : options.min_time);
    }
  SampleReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter, ".");
  benchmark::ClearRegisteredBenchmarks();
  if (fault) std::rethrow_exception(fault);

  for (const MicroGroup& group : bench.groups)
    for (const MicroFunction& function : group.functions) {
      const auto& [wall, cpu] = reporter.At(FullName(group, function));
      progress.Step("errors", 1.0);
      bench.rows.push_back({group.name, function.name, Quantile(wall, 0.5), Quantile(wall, 0.99),
                            Quantile(cpu, 0.5), function.error ? function.error() : MicroError{}});
    }
  return bench;
}

std::string TableOf(const MicroBench& bench) {
  std::string table =
      fmt::format("# micro: speed beside error | {} | {} samples of at least {:g} s{}\n",
                  MachineWords(), bench.options.quick ? 1 : bench.options.repetitions,
                  bench.options.quick ? 1e-4 : bench.options.min_time,
                  bench.options.quick ? " | quick: times mean nothing" : "");
  for (const MicroGroup& group : bench.groups) {
    table += fmt::format("\n# {}{}\n{:<52}{:>10}{:>10}{:>10}  {}\n", group.name,
                         group.reference.empty() ? "" : " | reference: " + group.reference,
                         "function", "median", "p99", "CPU", "error");
    for (const MicroRow& row : bench.rows)
      if (row.group == group.name)
        table += fmt::format("{:<52}{:>10}{:>10}{:>10}  {}\n", row.name, TimeText(row.wall),
                             TimeText(row.wall_p99), TimeText(row.cpu), row.error.text);
  }
  return table;
}

nlohmann::json JsonOf(const MicroBench& bench) {
  nlohmann::json groups = nlohmann::json::array(), rows = groups;
  for (const MicroGroup& group : bench.groups)
    groups.push_back(
        {{"group", group.name}, {"error", group.error}, {"reference", group.reference}});
  for (const MicroRow& row : bench.rows)
    rows.push_back({{"group", row.group},
                    {"function", row.name},
                    {"wall_ms_median", 1e3 * row.wall},
                    {"wall_ms_p99", 1e3 * row.wall_p99},
                    {"cpu_ms_median", 1e3 * row.cpu},
                    {"error", std::isfinite(row.error.value) ? nlohmann::json(row.error.value)
                                                             : nlohmann::json(nullptr)},
                    {"error_text", row.error.text}});
  return {{"schema", "arthroscene.bench.micro/1"},
          {"machine", MachineWords()},
          {"options", JsonFromOptions(bench.options)},
          {"groups", groups},
          {"rows", rows}};
}

std::string PlotOf(const MicroBench& bench, const MicroGroup& group) {
  std::vector<PlotMark> marks;
  for (const MicroRow& row : bench.rows)
    if (row.group == group.name && row.error.value > 0)
      marks.push_back({group.name, row.name, 1e3 * row.wall, row.error.value, 1.0});
  if (marks.empty()) return "";
  return SpeedErrorSvg({fmt::format("Micro-benchmarks, {}: speed against error", group.name),
                        "time per call, ms", group.error, "", group.reference},
                       marks);
}

std::string PlotOf(const MicroBench& bench) {
  for (const MicroGroup& group : bench.groups)
    if (std::string plot = PlotOf(bench, group); !plot.empty()) return plot;
  return SpeedErrorSvg({"Micro-benchmarks: speed against error", "time per call, ms", "error", "",
                        "none of these groups has an error above zero"},
                       {});
}

}  // namespace arthro::app
