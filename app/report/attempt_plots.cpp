#include "app/report/attempt_plots.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "app/plot/line_plot.h"
#include "app/plot/svg_text.h"

namespace arthro::app {
namespace {

using simulation::AttemptFrame;
using simulation::DeviceRole;
using simulation::ToolFrame;

constexpr double kWidth = 720;             // px
constexpr std::size_t kMostPoints = 1600;  // per curve; more than the plot has px
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double TimeOf(std::size_t frame) { return simulation::kFrameTime * static_cast<double>(frame + 1); }

std::vector<PlotLine> Divisions(const AttemptReport& report) {
  std::vector<PlotLine> divisions;
  for (const StepRow& step : report.attempt.steps)
    if (step.outcome != "pending")
      divisions.push_back({step.began, "step " + StepNumber(report.steps, step.step)});
  return divisions;
}

const ToolFrame& ToolOf(const AttemptFrame& frame, DeviceRole role) {
  return frame.tool[Index(role)];
}

std::string Shortened(std::string text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) --bytes;
  text.resize(bytes);
  return text + "…";
}

// Number, title and outcome of a step; a long title is cut.
std::string StepWords(const AttemptReport& report, const StepRow& step) {
  constexpr std::size_t kMostLetters = 40;
  const std::string& outcome = step.outcome;
  return fmt::format("{}: {}", Shortened(StepLine(report.steps, step.step), kMostLetters),
                     outcome == "pending"   ? "not begun"
                     : outcome == "running" ? "not done"
                                            : outcome);
}

}  // namespace

std::string StepsSvg(const AttemptReport& report) {
  constexpr double kRight = 20, kRow = 24, kTop = 8, kLetter = 6.6;
  const AttemptRecord& attempt = report.attempt;
  double left = 170;  // room for the longest words
  for (const StepRow& step : attempt.steps)
    left = std::max(left, 16 + kLetter * static_cast<double>(StepWords(report, step).size()));
  left = std::min(left, 0.5 * kWidth);
  double end = attempt.duration.value_or(0);
  for (const StepRow& step : attempt.steps) end = std::max(end, step.ended.value_or(step.began));
  for (const EventRow& event : attempt.events) end = std::max(end, event.t);
  if (attempt.steps.empty() || !(end > 0)) return "";
  const double height = kTop + kRow * static_cast<double>(attempt.steps.size()) + 46;
  const auto at = [&](double t) { return left + t / end * (kWidth - left - kRight); };
  std::string svg = SvgHead(kWidth, height);
  const auto text = [&](double x, double y, const char* anchor, const std::string& words) {
    svg += SvgText(x, y, 11, anchor, "#111111", words);
  };
  double y = kTop;
  std::map<std::string, double> row_of;
  for (const StepRow& step : attempt.steps) {
    const bool is_done = step.outcome == "done";
    const double stop = step.ended.value_or(end);
    row_of[step.step] = y;
    text(left - 8, y + 14, "end", StepWords(report, step));
    if (step.outcome == "pending") {  // it was never reached
      y += kRow;
      continue;
    }
    // A failed step is hatched, so that it is told apart in black and white.
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"14\" fill=\"{}\" "
        "stroke=\"#222222\"{}/>\n",
        at(step.began), y + 3, std::max(1.0, at(stop) - at(step.began)),
        is_done ? "#cfe6f5" : "#f7d9c4", is_done ? "" : " stroke-dasharray=\"3 2\"");
    text(std::min(at(stop) + 5, kWidth - kRight - 44), y + 14, "start",
         fmt::format("{:.1f} s", stop - step.began));
    y += kRow;
  }
  // Faults stand as marks in the row of their step.
  for (const EventRow& event : attempt.events)
    if (event.kind == "force_over" || event.kind == "zone_in" || event.kind == "cut_outside" ||
        event.kind == "drop" || event.kind == "bleed" || event.kind == "fault") {
      const double top = row_of.contains(event.step) ? row_of[event.step] + 3 : kTop - 11;
      svg +=
          fmt::format("<path d=\"M{:.1f} {:.1f}l4 -8h-8z\" fill=\"#a00000\"/>\n", at(event.t), top);
    }
  svg += fmt::format("<path d=\"M{:g} {:.1f}H{:g}\" stroke=\"#222222\"/>\n", left, y + 4,
                     kWidth - kRight);
  const double step = end > 240 ? 60 : end > 80 ? 20 : end > 30 ? 10 : end > 10 ? 5 : 1;
  for (double t = 0; t <= end; t += step) {
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}v5\" stroke=\"#222222\"/>\n", at(t), y + 4);
    text(at(t), y + 21, "middle", fmt::format("{:g}", t));
  }
  text(0.5 * (left + kWidth - kRight), y + 37, "middle", "Time, s; triangles: faults");
  return svg + "</svg>\n";
}

std::string ForceSvg(const AttemptReport& report) {
  LinePlot plot{"Force on the tip of the instrument", "Time, s", "Force, N"};
  Curve peak{"largest in 10 ms", {}}, mean{"mean in 10 ms", {}};
  for (std::size_t k = 0; k < report.frames.size(); ++k) {
    const ToolFrame& tool = ToolOf(report.frames[k], DeviceRole::kInstrument);
    const bool is_known = tool.is_valid && !report.frames[k].is_paused;
    peak.points.emplace_back(TimeOf(k), is_known ? tool.peak_force : kNothing);
    mean.points.emplace_back(TimeOf(k), is_known ? tool.mean_force : kNothing);
  }
  plot.curves = {Thinned(peak, kMostPoints), Thinned(mean, kMostPoints)};
  for (const CriterionRow& criterion : report.attempt.criteria)
    if (criterion.metric == "peak_force" && criterion.high)
      plot.limits.push_back({*criterion.high, fmt::format("limit {:g} N", *criterion.high)});
  plot.divisions = Divisions(report);
  plot.begins_at_zero = true;
  return LinePlotSvg(plot);
}

std::string CentringSvg(const AttemptReport& report) {
  LinePlot plot{"Targets in the picture: 0 is its centre, 1 its rim", "Time, s",
                "Distance from the centre"};
  for (std::size_t i = 0; i < report.targets.size(); ++i) {
    Curve curve{report.targets[i].id, {}};
    bool is_seen = false;
    for (std::size_t k = 0; k < report.frames.size(); ++k) {
      const simulation::Observation& sight = report.frames[k].sight;
      const bool is_clear = static_cast<int>(i) < sight.targets && sight.target[i].is_clear;
      is_seen |= is_clear;
      curve.points.emplace_back(TimeOf(k), is_clear ? sight.target[i].centre : kNothing);
    }
    if (is_seen) plot.curves.push_back(Thinned(curve, kMostPoints));
  }
  plot.divisions = Divisions(report);
  plot.begins_at_zero = true;
  plot.most_y = 1;
  return LinePlotSvg(plot);
}

std::string PathSvg(const AttemptReport& report, bool from_above) {
  LinePlot plot{from_above ? "Paths of the tips, from above" : "Paths of the tips, along the view",
                "Right, mm", from_above ? "Into the joint, mm" : "Up, mm"};
  plot.has_equal_scales = true;
  plot.width = kWidth / 2 - 8;
  plot.height = 300;
  for (const DeviceRole role : {DeviceRole::kScope, DeviceRole::kInstrument}) {
    Curve curve{role == DeviceRole::kScope ? "scope" : "instrument", {}};
    for (const AttemptFrame& frame : report.frames) {
      const ToolFrame& tool = ToolOf(frame, role);
      const bool is_known = tool.is_inside() && !frame.is_paused;
      const glm::dvec3 tip = 1000.0 * glm::dvec3(tool.tip);
      curve.points.emplace_back(is_known ? tip.x : kNothing, from_above ? tip.z : -tip.y);
    }
    plot.curves.push_back(Thinned(curve, 8 * kMostPoints));
  }
  return LinePlotSvg(plot);
}

}  // namespace arthro::app
