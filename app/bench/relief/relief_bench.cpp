#include "app/bench/relief/relief_bench.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/machine_words.h"
#include "app/bench/speed_error_plot.h"
#include "app/bench/table_number.h"
#include "simulation/core/options_json.h"

namespace arthro::app {
std::string TableOf(const ReliefBench& bench) {
  std::string table = fmt::format(
      "# relief: speed against error | {} | seed {}, {} touches\n"
      "{:<11}{:<34}{:>8}{:>10}{:>9}{:>9}{:>9}{:>8}{:>9}{:>9}{:>9}{:>9}  {}\n",
      MachineWords(), bench.options.seed, bench.options.touches, "clip", "way", "placed",
      "CPU ms/fr", "covered", "rmse mm", "med. mm", "< 1 mm", "Spearman", "apart px", "force N",
      "of N", "outcome");
  for (const ReliefBenchRow& row : bench.rows)
    table += fmt::format(
        "{:<11}{:<34}{:>8}{:>10}{:>9}{:>9}{:>9}{:>8}{:>9}{:>9}{:>9}{:>9}  {}\n", row.clip, row.way,
        fmt::format("{}/{}", row.placed, row.frames), TableNumber(row.cpu_ms, 1),
        TableNumber(row.coverage, 2), TableNumber(row.rmse_mm, 2), TableNumber(row.median_mm, 2),
        TableNumber(row.within_1mm, 2), TableNumber(row.spearman, 2), TableNumber(row.apart_px, 2),
        TableNumber(row.force_error, 3), TableNumber(row.force_of_truth, 3), row.outcome);
  return table +
         "Errors are those of the distance from the portal, over the directions that three frames "
         "see: after the similarity\nthat fits the cameras best for motion, and after the affine "
         "law that fits the truth best for brightness.\nCOLMAP gives points: they cover the cells "
         "of half a degree that hold one.\nforce N: rms difference from the force over the true "
         "surface; of N: rms of that force.\n";
}

nlohmann::json JsonOf(const ReliefBench& bench) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
  };
  nlohmann::json rows = nlohmann::json::array();
  for (const ReliefBenchRow& row : bench.rows)
    rows.push_back({{"clip", row.clip},
                    {"way", row.way},
                    {"outcome", row.outcome},
                    {"frames", row.frames},
                    {"placed", row.placed},
                    {"cpu_ms_per_frame", number(row.cpu_ms)},
                    {"coverage", number(row.coverage)},
                    {"rmse_mm", number(row.rmse_mm)},
                    {"median_mm", number(row.median_mm)},
                    {"within_1mm", number(row.within_1mm)},
                    {"spearman", number(row.spearman)},
                    {"apart_px", number(row.apart_px)},
                    {"force_error", number(row.force_error)},
                    {"force_of_truth", number(row.force_of_truth)}});
  return {{"schema", "arthroscene.bench.relief/1"},
          {"machine", MachineWords()},
          {"options", JsonFromOptions(bench.options)},
          {"rows", rows}};
}

std::string PlotOf(const ReliefBench& bench) {
  std::vector<PlotMark> marks;
  for (const ReliefBenchRow& row : bench.rows)
    if (std::isfinite(row.cpu_ms))  // it ran
      marks.push_back({row.clip, row.way, row.cpu_ms, row.rmse_mm,
                       std::isfinite(row.coverage) ? row.coverage : 0});
  return SpeedErrorSvg({"Relief: speed against error", "processor time per frame, ms",
                        "error of the distance from the portal, rms, mm",
                        "filled: share of the directions covered; top edge: no surface",
                        "exact surface of the rendered clips"},
                       marks);
}

}  // namespace arthro::app
