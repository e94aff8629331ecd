#include "app/bench/view/view_bench.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/machine_words.h"
#include "app/bench/speed_error_plot.h"
#include "app/bench/table_number.h"
#include "simulation/core/options_json.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

using namespace test;

// A column's number, or a dash where there is none.
std::string Column(std::optional<double> value, int width, int digits) {
  return value && std::isfinite(*value) ? fmt::format("{:>{}.{}f}", *value, width, digits)
                                        : fmt::format("{:>{}}", "-", width);
}

template <class Whole, class Part>
std::optional<double> PartOf(const std::optional<Whole>& whole, Part Whole::*part,
                             double factor = 1) {
  if (!whole) return std::nullopt;
  return factor * (*whole).*part;
}

nlohmann::json JsonOf(std::optional<double> value) {
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace

std::string TableOf(const ViewBench& bench) {
  std::string table = fmt::format(
      "# view: speed against error | {} | drawn by {} | {} frames a row\n"
      "{:>5}{:>6} {:<46}{:>8}{:>8} |{:>8}{:>8} |{:>9}{:>9}{:>10} |{:>8}{:>8}\n"
      "{:>5}{:>6} {:<46}{:>8}{:>8} |{:>8}{:>8} |{:>9}{:>9}{:>10} |{:>8}{:>8}\n",
      MachineWords(), bench.drawn_by, bench.options.timed_frames,  //
      "size", "pano", "picture", "wall ms", "", "cpu ms", "", "ends", "others", "colour", "lines",
      "px",  //
      "px", "px", "", "median", "p99", "median", "p99", "off %", "rms mm", "off %", "rms", "max");
  for (const ViewBenchRow& row : bench.rows) {
    const FrameTimes& t = row.times;
    table += fmt::format("{:>5}{:>6} {:<46}{:>8.1f}{:>8.1f} |{:>8.1f}{:>8.1f} |{}{}{} |{}{}\n",
                         row.size, row.panorama, row.words, kMilli * t.wall, kMilli * t.wall_p99,
                         kMilli * t.cpu, kMilli * t.cpu_p99,
                         Column(PartOf(row.traced, &TracedAgreement::elsewhere, 100), 9, 2),
                         Column(PartOf(row.traced, &TracedAgreement::rms, MmFromMetres(1)), 9, 4),
                         Column(PartOf(row.traced, &TracedAgreement::off_colour, 100), 10, 2),
                         Column(PartOf(row.grid, &GridAgreement::rms_px), 8, 3),
                         Column(PartOf(row.grid, &GridAgreement::max_px), 8, 3));
  }
  table += fmt::format(
      "ends off: share of {} random pixels whose ray ends more than {:g} mm from where the ray "
      "tracer's does; others: those that do not;\ncolour off: share more than {:g}/255 off, where "
      "a picture has its footage's own colours; lines: of a grid, against the closed form.\n"
      "The tracer's outlines are laid through the depth map's stairs as the picture's are; by the "
      "map's stairs: against it as it is.\n"
      "wall: what a user waits; cpu: of all threads. p99 of fewer than 100 frames is the "
      "slowest.\n",
      bench.options.pixels, MmFromMetres(kSameDistance), kSameColour);
  return table + "\n" + TableOf(bench.costs);
}

nlohmann::json JsonOf(const ViewBench& bench) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ViewBenchRow& row : bench.rows)
    rows.push_back({{"part", row.part},
                    {"picture", row.words},
                    {"size", row.size},
                    {"panorama", row.panorama},
                    {"relief_steps", row.relief.steps},
                    {"relief_cell", row.relief.cell},
                    {"samples", row.samples},
                    {"triangles", row.triangles},
                    {"wall_ms_median", kMilli * row.times.wall},
                    {"wall_ms_p99", kMilli * row.times.wall_p99},
                    {"cpu_ms_median", kMilli * row.times.cpu},
                    {"cpu_ms_p99", kMilli * row.times.cpu_p99},
                    {"compared", row.traced ? row.traced->compared
                                 : row.grid ? row.grid->crossings
                                            : 0},
                    {"ends_off", JsonOf(PartOf(row.traced, &TracedAgreement::elsewhere))},
                    {"others_rms", JsonOf(PartOf(row.traced, &TracedAgreement::rms))},
                    {"colour_off", JsonOf(PartOf(row.traced, &TracedAgreement::off_colour))},
                    {"lines_rms_px", JsonOf(PartOf(row.grid, &GridAgreement::rms_px))},
                    {"lines_max_px", JsonOf(PartOf(row.grid, &GridAgreement::max_px))}});
  return {{"schema", "arthroscene.bench.view/1"},
          {"machine", MachineWords()},
          {"drawn_by", bench.drawn_by},
          {"options", JsonFromOptions(bench.options)},
          {"rows", rows},
          {"costs", JsonOf(bench.costs)}};
}

std::string PlotOf(const ViewBench& bench) {
  std::vector<PlotMark> marks;
  for (const ViewBenchRow& row : bench.rows)
    if (row.traced && row.part != "stairs")
      marks.push_back({fmt::format("{} px, panorama {}", row.size, row.panorama), row.words,
                       kMilli * row.times.wall, 100 * row.traced->elsewhere,
                       row.relief == kUsualRelief ? 1.0 : 0.0});
  return SpeedErrorSvg(
      {"Arthroscopic view: speed against error", "wall clock per frame, ms",
       fmt::format("pixels whose ray ends more than {:g} mm off, %", MmFromMetres(kSameDistance)),
       fmt::format("filled: default search, {} steps, cells of {}", kUsualRelief.steps,
                   kUsualRelief.cell),
       "ray tracer in double precision without OpenGL"},
      marks);
}

}  // namespace arthro::app
