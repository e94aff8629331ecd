// Distance of the tissue along the profile line, as a curve.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/plot.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr unsigned kBand = 0x50D6B24A, kGrid = 0x40B4AAA2;

// Coordinates of the curve in the window.
struct Axes {
  Area area;
  double last_angle = 1, low = 0, high = 1;  // rad; m
  ImVec2 At(double angle, double range) const {
    return {area.x + area.width * static_cast<float>(angle / last_angle),
            area.y + area.height * static_cast<float>((high - range) / (high - low))};
  }
};

void Grid(Ui& ui, const Axes& axes) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const Area& area = axes.area;
  const auto label = [&](const ImVec2& at, const std::string& words) {
    ui.widgets.RecordText(words);
    draw->AddText(at, kQuiet, words.c_str());
  };
  const double low = MmFromMetres(axes.low), high = MmFromMetres(axes.high);
  const double step = RoundStep(high - low, std::max(2, static_cast<int>(area.height / ui.Px(28))));
  for (double mm = std::ceil(low / step) * step; mm <= high; mm += step) {
    const float y = axes.At(0, MetresFromMm(mm)).y;
    draw->AddLine({area.x, y}, {area.x + area.width, y}, kGrid);
    const std::string words = fmt::format("{:g}", std::round(mm * 100) / 100);
    label({area.x - ImGui::CalcTextSize(words.c_str()).x - ui.Px(6),
           y - 0.5f * ImGui::GetTextLineHeight()},
          words);
  }
  const double degrees = DegreesFromRadians(axes.last_angle);
  const double across = RoundStep(degrees, std::max(2, static_cast<int>(area.width / ui.Px(90))));
  for (double at = 0; at <= degrees; at += across) {
    const float x = axes.At(RadiansFromDegrees(at), axes.low).x;
    draw->AddLine({x, area.y}, {x, area.y + area.height}, kGrid);
    label({x + ui.Px(3), area.y + area.height + ui.Px(3)},
          fmt::format("{:g}°", std::round(at * 100) / 100));
  }
}

void Curve(Ui& ui, const Axes& axes, const std::vector<authoring::ProfileSample>& samples) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float dash = ui.Px(6);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto& a = samples[i - 1];
    const auto& b = samples[i];
    if (!std::isfinite(a.reading.range) || !std::isfinite(b.reading.range)) continue;
    if (std::isfinite(a.reading.sigma) && std::isfinite(b.reading.sigma))
      draw->AddQuadFilled(axes.At(a.angle, a.reading.range + a.reading.sigma),
                          axes.At(b.angle, b.reading.range + b.reading.sigma),
                          axes.At(b.angle, b.reading.range - b.reading.sigma),
                          axes.At(a.angle, a.reading.range - a.reading.sigma), kBand);
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto& a = samples[i - 1];
    const auto& b = samples[i];
    if (!std::isfinite(a.reading.range) || !std::isfinite(b.reading.range)) continue;
    const ImVec2 from = axes.At(a.angle, a.reading.range), to = axes.At(b.angle, b.reading.range);
    const bool is_measured = b.reading.origin == ReliefOrigin::kMeasured;
    if (!is_measured && std::fmod(to.x - axes.area.x, 2 * dash) > dash) continue;
    draw->AddLine(from, to, is_measured ? kAccent : kWarning, ui.Px(2));
  }
}

}  // namespace

void ProfileFigure(Ui& ui, const EditorState& state, const Area& area) {
  const DepthBoard& board = state.steps.depth->board;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF231E1B);
  const auto note = [&](const char* words) {
    ui.widgets.RecordText(words);
    const std::string shown = ui.In(words);
    const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
    draw->AddText({area.x + 0.5f * (area.width - size.x), area.y + 0.5f * (area.height - size.y)},
                  kQuiet, shown.c_str());
  };
  if (!board.profile.is_complete()) return note("The profile of a line appears here.");
  const auto samples = authoring::SampleProfile(ReliefViewOf(state.document()), *board.profile.from,
                                                *board.profile.to);
  const authoring::RangeSpan span = authoring::RangesOf(samples);
  if (samples.empty() || !(span.furthest > 0)) return note("No depth is known along this line.");

  Axes axes;
  axes.area = {area.x + ui.Px(54), area.y + ui.Px(30), std::max(1.0f, area.width - ui.Px(54 + 16)),
               std::max(1.0f, area.height - ui.Px(30 + 26))};
  axes.last_angle = std::max(samples.back().angle, 1e-6);
  const double margin = std::max(0.08 * (span.furthest - span.nearest), 2e-4);
  axes.low = span.nearest - margin;
  axes.high = span.furthest + margin;
  Grid(ui, axes);
  Curve(ui, axes, samples);
  const char* title = "Distance from the portal along the line, mm";
  ui.widgets.RecordText(title);
  draw->AddText({area.x + ui.Px(12), area.y + ui.Px(7)}, kBright, ui.In(title).c_str());
}

}  // namespace arthro::app
