#include "app/plot/line_plot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "app/plot/svg_text.h"

namespace arthro::app {
namespace {

constexpr double kLeft = 62, kRight = 16, kTop = 46, kBottom = 44;  // px around the axes
constexpr double kFont = 11, kTitleFont = 13;

// Linear axis from a value to a value, at px to px.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  double At(double value) const { return from + (value - low) / (high - low) * (to - from); }
  bool Holds(double value) const { return value >= low && value <= high; }
};

// The step of 1, 2 or 5 times a power of ten that gives at most `most` ticks.
double StepOf(double range, int most) {
  const double power = std::pow(10.0, std::floor(std::log10(range / most)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (range / (factor * power) <= most) return factor * power;
  return 10 * power;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void Add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool is_empty() const { return least > most; }
  void Widen(double share) {
    const double more = most > least ? share * (most - least) : std::max(0.5 * std::abs(most), 0.5);
    least -= more;
    most += more;
  }
};

bool IsFinite(const std::pair<double, double>& point) {
  return std::isfinite(point.first) && std::isfinite(point.second);
}

class Drawing {
 public:
  explicit Drawing(const LinePlot& plot) : plot_(plot) {}

  std::string Draw() {
    svg_ += SvgHead(plot_.width, plot_.height);
    Text(kLeft, 18, kTitleFont, "start", "#111111", plot_.title);
    if (!MakeAxes()) {
      Text(plot_.width / 2, plot_.height / 2, kFont, "middle", "#666666", "Nothing was measured.");
      return svg_ + "</svg>\n";
    }
    DrawLegend();
    DrawGrid();
    DrawCurves();
    return svg_ + "</svg>\n";
  }

 private:
  template <class... Values>
  void Put(fmt::format_string<Values...> form, Values&&... values) {
    fmt::format_to(std::back_inserter(svg_), form, std::forward<Values>(values)...);
  }
  void Text(double x, double y, double font, const char* anchor, const char* colour,
            const std::string& text) {
    svg_ += SvgText(x, y, font, anchor, colour, text);
  }

  bool MakeAxes() {
    Extent x, y;
    for (const Curve& curve : plot_.curves)
      for (const auto& point : curve.points)
        if (IsFinite(point)) {
          x.Add(point.first);
          y.Add(point.second);
        }
    if (x.is_empty()) return false;
    for (const PlotLine& limit : plot_.limits) y.Add(limit.at);
    y.Widen(0.06);
    if (plot_.has_equal_scales || x.most <= x.least) x.Widen(0.06);
    if (plot_.begins_at_zero) y.least = 0;
    if (plot_.most_y) y.most = std::max(y.most, *plot_.most_y);
    const double wide = plot_.width - kLeft - kRight, high = plot_.height - kTop - kBottom;
    if (plot_.has_equal_scales) {
      const double per_px = std::max((x.most - x.least) / wide, (y.most - y.least) / high);
      const double cx = 0.5 * (x.least + x.most), cy = 0.5 * (y.least + y.most);
      x = {cx - 0.5 * per_px * wide, cx + 0.5 * per_px * wide};
      y = {cy - 0.5 * per_px * high, cy + 0.5 * per_px * high};
    }
    x_ = {x.least, x.most, kLeft, plot_.width - kRight};
    y_ = {y.least, y.most, plot_.height - kBottom, kTop};
    return true;
  }

  void DrawLegend() {
    double x = kLeft;
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      if (plot_.curves[i].name.empty()) continue;
      Put("<path d=\"M{:.1f} 30h16\" stroke=\"{}\" stroke-width=\"2\"/>\n", x, ColourOf(i));
      Text(x + 21, 34, kFont, "start", "#111111", plot_.curves[i].name);
      x += 36 + TextWidth(plot_.curves[i].name, kFont);
    }
  }

  // Highest baseline for the words of the divisions that crosses no limit and none of their words.
  double DivisionBaseline() const {
    constexpr double kAbove = 11, kBelow = 3, kLimitWords = 16;  // px
    double baseline = kTop + kAbove;
    for (std::size_t i = 0; i < plot_.limits.size(); ++i)
      for (const PlotLine& limit : plot_.limits) {
        const double line = y_.At(limit.at);
        if (baseline + kBelow > line - kLimitWords && baseline - kAbove < line + kBelow)
          baseline = line + kBelow + kAbove;
      }
    return baseline;
  }

  void DrawGrid() {
    const int across = static_cast<int>((plot_.width - kLeft - kRight) / 70);
    const int upward = static_cast<int>((plot_.height - kTop - kBottom) / 34);
    const auto each = [](const Axis& axis, int most, const auto& draw) {
      const double step = StepOf(axis.high - axis.low, std::max(2, most));
      for (double k = std::ceil(axis.low / step); k * step <= axis.high * (1 + 1e-12) + 1e-300; ++k)
        draw(k * step + 0.0,
             fmt::format("{:.6g}", std::abs(k * step) < 1e-9 * step ? 0 : k * step));
    };
    each(x_, across, [&](double value, const std::string& words) {
      Put("<path d=\"M{:.1f} {:g}V{:g}\" stroke=\"#e4e4e4\"/>\n", x_.At(value), kTop,
          plot_.height - kBottom);
      Text(x_.At(value), plot_.height - kBottom + 15, kFont, "middle", "#444444", words);
    });
    each(y_, upward, [&](double value, const std::string& words) {
      Put("<path d=\"M{:g} {:.1f}H{:g}\" stroke=\"#e4e4e4\"/>\n", kLeft, y_.At(value),
          plot_.width - kRight);
      Text(kLeft - 6, y_.At(value) + 4, kFont, "end", "#444444", words);
    });
    double last = -1e9;  // px, end of the last label, so that none lies on another
    for (const PlotLine& division : plot_.divisions) {
      if (!x_.Holds(division.at)) continue;
      const double x = x_.At(division.at);
      Put("<path d=\"M{:.1f} {:g}V{:g}\" stroke=\"#888888\" stroke-dasharray=\"2 3\"/>\n", x, kTop,
          plot_.height - kBottom);
      const double width = TextWidth(division.words, kFont);
      if (x < last || x + 4 + width > plot_.width) continue;
      Text(x + 4, DivisionBaseline(), kFont, "start", "#555555", division.words);
      last = x + 8 + width;
    }
    for (const PlotLine& limit : plot_.limits) {
      Put("<path d=\"M{:g} {:.1f}H{:g}\" stroke=\"#a00000\" stroke-width=\"1.2\" "
          "stroke-dasharray=\"6 3\"/>\n",
          kLeft, y_.At(limit.at), plot_.width - kRight);
      Text(plot_.width - kRight - 4, y_.At(limit.at) - 4, kFont, "end", "#a00000", limit.words);
    }
    Put("<path d=\"M{:g} {:g}V{:g}H{:g}\" fill=\"none\" stroke=\"#222222\"/>\n", kLeft, kTop,
        plot_.height - kBottom, plot_.width - kRight);
    Text(0.5 * (kLeft + plot_.width - kRight), plot_.height - 10, kFont, "middle", "#111111",
         plot_.x);
    Put("<text transform=\"translate(14 {:.1f}) rotate(-90)\" font-size=\"{:g}\" "
        "text-anchor=\"middle\" fill=\"#111111\">{}</text>\n",
        0.5 * (kTop + plot_.height - kBottom), kFont, XmlText(plot_.y));
  }

  void DrawCurves() {
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      std::string path;
      bool is_down = false;
      for (const auto& point : plot_.curves[i].points) {
        if (!IsFinite(point)) {
          is_down = false;
          continue;
        }
        fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", is_down ? 'L' : 'M',
                       x_.At(point.first), y_.At(point.second));
        is_down = true;
      }
      if (!path.empty())
        Put("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\" "
            "stroke-linejoin=\"round\"/>\n",
            path, ColourOf(i));
    }
  }

  static const char* ColourOf(std::size_t i) { return kSeriesColours[i % kSeriesColours.size()]; }

  const LinePlot& plot_;
  Axis x_, y_;
  std::string svg_;
};

}  // namespace

std::string LinePlotSvg(const LinePlot& plot) { return Drawing(plot).Draw(); }

Curve Thinned(const Curve& curve, std::size_t most) {
  const std::size_t n = curve.points.size();
  if (n <= most || most < 4) return curve;
  Curve thin{curve.name, {}};
  const std::size_t groups = most / 4;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t begin = g * n / groups, end = (g + 1) * n / groups;
    std::vector<std::size_t> kept = {begin, end - 1};
    std::size_t least = begin, largest = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (!IsFinite(curve.points[i])) continue;
      if (!(curve.points[i].second >= curve.points[least].second)) least = i;
      if (!(curve.points[i].second <= curve.points[largest].second)) largest = i;
    }
    kept.push_back(least);
    kept.push_back(largest);
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const std::size_t i : kept) thin.points.push_back(curve.points[i]);
  }
  return thin;
}

}  // namespace arthro::app
