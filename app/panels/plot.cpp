#include "app/panels/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace arthro::app {
namespace {

constexpr unsigned kGround = 0xFF231E1B, kBand = 0x3050A050, kGrid = 0x40B4AAA2;

// Coordinates of the curves in the window.
struct Axes {
  Area area;
  double left, right, low, high;
  ImVec2 At(double x, double y) const {
    return {area.x + area.width * static_cast<float>((x - left) / (right - left)),
            area.y + area.height * static_cast<float>((high - y) / (high - low))};
  }
};

std::string NumberWords(double value, double step) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  return fmt::format("{:.{}f}", std::abs(value) < 1e-9 * step ? 0.0 : value, digits);
}

Axes AxesOf(const Ui& ui, const Plot& plot, const Area& area) {
  Axes axes{{area.x + ui.Px(46), area.y + ui.Px(26), std::max(1.0f, area.width - ui.Px(46 + 12)),
             std::max(1.0f, area.height - ui.Px(26 + 22))},
            plot.left,
            plot.right,
            plot.low,
            plot.high};
  if (!(axes.right > axes.left)) axes.right = axes.left + 1;
  if (!(axes.high > axes.low)) axes.high = axes.low + 1;
  if (!plot.is_equal) return axes;
  const double x_scale = (axes.right - axes.left) / axes.area.width;
  const double y_scale = (axes.high - axes.low) / axes.area.height;
  const double scale = std::max(x_scale, y_scale);
  const double more_x = 0.5 * (scale * axes.area.width - (axes.right - axes.left));
  const double more_y = 0.5 * (scale * axes.area.height - (axes.high - axes.low));
  return {axes.area, axes.left - more_x, axes.right + more_x, axes.low - more_y,
          axes.high + more_y};
}

// In a narrow plot the letters get smaller, down to a half.
void Title(const Ui& ui, const std::string& words, const Area& area) {
  const float room = area.width - ui.Px(20), width = ImGui::CalcTextSize(words.c_str()).x;
  const float size = ImGui::GetFontSize() * std::clamp(room / std::max(width, 1.0f), 0.5f, 1.0f);
  ImGui::GetWindowDrawList()->AddText(
      ImGui::GetFont(), size, {area.x + ui.Px(10), area.y + ui.Px(5)}, kBright, words.c_str());
}

void Grid(Ui& ui, const Plot& plot, const Axes& axes) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const Area& area = axes.area;
  const double up =
      RoundStep(axes.high - axes.low, std::max(2, static_cast<int>(area.height / ui.Px(34))));
  for (double y = std::ceil(axes.low / up - 1e-9) * up; y <= axes.high + 1e-9 * up; y += up) {
    const ImVec2 at = axes.At(axes.left, y);
    draw->AddLine(at, {area.x + area.width, at.y}, kGrid);
    const std::string words = NumberWords(y, up);
    draw->AddText({area.x - ImGui::CalcTextSize(words.c_str()).x - ui.Px(6),
                   at.y - 0.5f * ImGui::GetTextLineHeight()},
                  kQuiet, words.c_str());
  }
  double across =
      RoundStep(axes.right - axes.left, std::max(2, static_cast<int>(area.width / ui.Px(80))));
  if (plot.has_whole_steps) across = std::max(1.0, across);
  for (double x = std::ceil(axes.left / across - 1e-9) * across; x <= axes.right + 1e-9 * across;
       x += across) {
    const ImVec2 at = axes.At(x, axes.low);
    draw->AddLine({at.x, area.y}, at, kGrid);
    const std::string words = NumberWords(x, across) + plot.x_unit;
    const float width = ImGui::CalcTextSize(words.c_str()).x;
    draw->AddText({std::min(at.x - 0.5f * width, area.x + area.width - width), at.y + ui.Px(3)},
                  kQuiet, words.c_str());
  }
}

void Curve(const Ui& ui, const PlotCurve& curve, const Axes& axes) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (!std::isfinite(curve.points[i].y)) continue;
    const ImVec2 at = axes.At(curve.points[i].x, curve.points[i].y);
    if (curve.has_dots) draw->AddCircleFilled(at, ui.Px(3.5), curve.colour);
    if (i > 0 && std::isfinite(curve.points[i - 1].y))
      draw->AddLine(axes.At(curve.points[i - 1].x, curve.points[i - 1].y), at, curve.colour,
                    ui.Px(1.5));
  }
}

}  // namespace

double RoundStep(double span, int most) {
  const double rough = std::max(span / most, 1e-9);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

void FitAxes(Plot& plot) {
  constexpr float kFar = std::numeric_limits<float>::max();
  ImVec2 least{kFar, kFar}, most{-kFar, -kFar};
  for (const PlotCurve& curve : plot.curves)
    for (const ImVec2& point : curve.points) {
      if (!std::isfinite(point.y)) continue;
      least = {std::min(least.x, point.x), std::min(least.y, point.y)};
      most = {std::max(most.x, point.x), std::max(most.y, point.y)};
    }
  if (least.x > most.x) {  // no value anywhere: axes that can still be drawn
    if (!(plot.left < plot.right)) plot.left = 0, plot.right = 1;
    if (!(plot.low < plot.high)) plot.low = 0, plot.high = 1;
    return;
  }
  const double spread = static_cast<double>(most.y) - static_cast<double>(least.y);
  const double below = 0.05 * std::max(1e-9, spread);
  // Ends of a curve over the plane have dots too; over time it fills the width.
  const double beside = plot.is_equal ? 0.05 * (double{most.x} - double{least.x}) : 0;
  plot.left = std::min(plot.left, least.x - beside);
  plot.right = std::max(plot.right, most.x + beside);
  plot.low = std::min(plot.low, least.y - below);
  // A single value has no spread; its dot is not to be cut off either.
  plot.high =
      std::max(plot.high, most.y + 0.05 * std::max(1e-9, static_cast<double>(most.y) - plot.low));
}

std::optional<double> DrawPlot(Ui& ui, const Plot& plot, const Area& area) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  ImGui::SetCursorScreenPos({area.x, area.y});
  HitArea(plot.title.c_str(), {area.width, area.height});
  const bool is_held = ImGui::IsItemActive();
  RecordItem(ui, plot.title, true, "", WidgetKind::kShown);
  const ImVec2 far_corner{area.x + area.width, area.y + area.height};
  draw->AddRectFilled({area.x, area.y}, far_corner, kGround, ui.Px(4));
  Title(ui, ui.In(plot.title), area);

  const Axes axes = AxesOf(ui, plot, area);
  draw->PushClipRect({area.x, area.y}, far_corner, true);
  for (const auto& [low, high] : plot.bands)
    draw->AddRectFilled(axes.At(axes.left, std::min(high, axes.high)),
                        axes.At(axes.right, std::max(low, axes.low)), kBand);
  Grid(ui, plot, axes);
  draw->PushClipRect({axes.area.x, axes.area.y},
                     {axes.area.x + axes.area.width, axes.area.y + axes.area.height}, true);
  for (const auto& [x, colour] : plot.marks)
    draw->AddLine(axes.At(x, axes.low), axes.At(x, axes.high), colour, ui.Px(1));
  for (const double limit : plot.limits)
    draw->AddLine(axes.At(axes.left, limit), axes.At(axes.right, limit), kBad, ui.Px(1.5));
  for (const PlotCurve& curve : plot.curves) Curve(ui, curve, axes);
  if (plot.cursor)
    draw->AddLine(axes.At(*plot.cursor, axes.low), axes.At(*plot.cursor, axes.high), kBright,
                  ui.Px(1.5));
  draw->PopClipRect();
  draw->PopClipRect();
  if (!is_held) return std::nullopt;
  const double share = (ImGui::GetIO().MousePos.x - axes.area.x) / axes.area.width;
  return std::clamp(axes.left + share * (axes.right - axes.left), plot.left, plot.right);
}

}  // namespace arthro::app
