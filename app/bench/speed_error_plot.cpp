#include "app/bench/speed_error_plot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "app/plot/svg_text.h"

namespace arthro::app {
namespace {

constexpr double kWidth = 1120, kHeight = 720;
constexpr double kLeft = 84, kRight = 24, kBottom = 64;
constexpr double kMarkRadius = 6;
constexpr double kLabelFont = 11, kLegendFont = 12;

// A logarithmic axis whose ends are 1, 2 or 5 times a power of ten.
struct Axis {
  double low = 1, high = 10, from = 0, to = 1;  // values; pixels
  double At(double value) const {
    const double share = std::log(value / low) / std::log(high / low);
    return from + std::clamp(share, 0.0, 1.0) * (to - from);
  }
};

constexpr double kLeast = 1e-9, kMost = 5e9;  // ends of any axis

// Powers of ten over many decades; 1, 2 and 5 times these over few.
std::vector<double> Ticks(double low, double high) {
  constexpr double kManyDecades = 1e4;
  std::vector<double> ticks;
  for (int e = -9; e <= 9; ++e)
    for (const double m : {1.0, 2.0, 5.0})
      if (const double t = m * std::pow(10.0, e);
          t >= low * 0.999 && t <= high * 1.001 && (m == 1 || high / low < kManyDecades))
        ticks.push_back(t);
  return ticks;
}

Axis AxisOver(double least, double most, double from, double to) {
  Axis axis{kLeast, kMost, from, to};
  for (int e = -9; e <= 9; ++e)
    for (const double m : {1.0, 2.0, 5.0}) {
      const double t = m * std::pow(10.0, e);
      if (t <= least * 0.9) axis.low = t;
      if (t >= most * 1.1) axis.high = std::min(axis.high, t);
    }
  return axis;
}

struct Box {
  double x, y, w, h;  // px
  bool Meets(const Box& o) const {
    return x < o.x + o.w && o.x < x + w && y < o.y + o.h && o.y < y + h;
  }
};

// The values of a plot's marks from the least to the most, on one axis.
struct Extent {
  double least, most;
  bool is_empty = true;
  void Add(double value) {
    if (!(std::isfinite(value) && value > 0)) return;
    least = is_empty ? value : std::min(least, value);
    most = is_empty ? value : std::max(most, value);
    is_empty = false;
  }
};

class Plot {
 public:
  Plot(const PlotWords& words, const std::vector<PlotMark>& marks) : words_(words), marks_(marks) {
    for (const PlotMark& mark : marks_)
      if (std::find(series_.begin(), series_.end(), mark.series) == series_.end())
        series_.push_back(mark.series);
  }
  std::string Draw() {
    DrawHead();
    DrawAxes();
    DrawMarks();
    for (const PlotMark& mark : marks_) DrawLabel(mark);
    if (unlabelled_ > 0)
      Text(kWidth - kRight, top_ - 8, kLabelFont, "end", "#666666",
           fmt::format("{} of {} marks have no room for a label; the table names them", unlabelled_,
                       marks_.size()));
    return svg_ + labels_ + "</svg>\n";
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
  const char* ColourOf(const std::string& series) const {
    const auto at = std::find(series_.begin(), series_.end(), series) - series_.begin();
    return kSeriesColours[static_cast<std::size_t>(at) % kSeriesColours.size()];
  }
  std::pair<double, double> PlaceOf(const PlotMark& mark) const {
    return {x_.At(mark.milliseconds),
            std::isfinite(mark.error) ? y_.At(mark.error) : top_ + kMarkRadius};
  }
  void DrawHead();
  void DrawAxes();
  void DrawMarks();
  void DrawLabel(const PlotMark& mark);
  bool IsFree(const Box& box) const {
    return box.x > kLeft + 2 && box.x + box.w < kWidth - 4 && box.y > top_ &&
           box.y + box.h < kHeight - kBottom &&
           std::none_of(taken_.begin(), taken_.end(),
                        [&](const Box& other) { return box.Meets(other); });
  }

  const PlotWords& words_;
  const std::vector<PlotMark>& marks_;
  std::vector<std::string> series_;  // in the order of first appearance
  std::string svg_;
  double top_ = 0;  // px, of the axes
  Axis x_, y_;
  std::vector<Box> taken_;
  std::string labels_;  // drawn last, over the lines
  int unlabelled_ = 0;
};

// Title, reference, meaning of the filling, legend: one line each, the legend as many as it needs.
void Plot::DrawHead() {
  svg_ += SvgHead(kWidth, kHeight);
  double y = 28;
  Text(kLeft, y, 17, "start", "#111111", words_.title);
  for (const std::string& line :
       {words_.reference.empty() ? "" : "reference: " + words_.reference, words_.share})
    if (!line.empty()) Text(kLeft, y += 18, kLegendFont, "start", "#444444", line);
  double x = kLeft;
  y += 22;
  for (const std::string& name : series_) {
    const double width = 18 + TextWidth(name, kLegendFont) + 18;
    if (x > kLeft && x + width > kWidth - kRight) {
      x = kLeft;
      y += 18;
    }
    Put("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"/>\n", x + 6, y - 4, kMarkRadius,
        ColourOf(name));
    Text(x + 18, y, kLegendFont, "start", "#111111", name);
    x += width;
  }
  top_ = y + 30;
}

void Plot::DrawAxes() {
  Extent x{10, 100}, y{0.1, 10};
  for (const PlotMark& mark : marks_) {
    x.Add(mark.milliseconds);
    y.Add(mark.error);
  }
  x_ = AxisOver(x.least, x.most, kLeft, kWidth - kRight);
  y_ = AxisOver(y.least, y.most, kHeight - kBottom, top_ + 28);
  for (const double t : Ticks(x_.low, x_.high)) {
    Put("<path d=\"M{:.1f} {:.1f}V{:g}\" stroke=\"#e4e4e4\"/>\n", x_.At(t), top_,
        kHeight - kBottom);
    Text(x_.At(t), kHeight - kBottom + 18, kLegendFont, "middle", "#444444",
         fmt::format("{:g}", t));
  }
  for (const double t : Ticks(y_.low, y_.high)) {
    Put("<path d=\"M{:g} {:.1f}H{:g}\" stroke=\"#e4e4e4\"/>\n", kLeft, y_.At(t), kWidth - kRight);
    Text(kLeft - 8, y_.At(t) + 4, kLegendFont, "end", "#444444", fmt::format("{:g}", t));
  }
  Put("<path d=\"M{:g} {:.1f}V{:g}H{:g}\" fill=\"none\" stroke=\"#222222\"/>\n", kLeft, top_,
      kHeight - kBottom, kWidth - kRight);
  Text((kLeft + kWidth - kRight) / 2, kHeight - 18, kLegendFont, "middle", "#111111", words_.x);
  Put("<text transform=\"translate(20 {:.1f}) rotate(-90)\" font-size=\"{:g}\" "
      "text-anchor=\"middle\" fill=\"#111111\">{}</text>\n",
      (top_ + kHeight - kBottom) / 2, kLegendFont, XmlText(words_.y));
}

void Plot::DrawMarks() {
  for (const PlotMark& mark : marks_) {
    const auto [x, y] = PlaceOf(mark);
    Put("<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:g}\" fill=\"{3}\" "
        "fill-opacity=\"{4:.2f}\" stroke=\"{3}\" stroke-width=\"1.5\"/>\n",
        x, y, kMarkRadius, ColourOf(mark.series), std::clamp(mark.share, 0.0, 1.0));
    constexpr double kReach = kMarkRadius + 1;  // includes the stroke
    taken_.push_back({x - kReach, y - kReach, 2 * kReach, 2 * kReach});
  }
}

// Tries places beside the mark first, then rings around it up to kFurthest away.
void Plot::DrawLabel(const PlotMark& mark) {
  constexpr double kFurthest = 300, kRing = 8;  // px
  constexpr int kDirections = 24;
  const auto [x, y] = PlaceOf(mark);
  const double w = TextWidth(mark.words, kLabelFont), h = 14;
  for (double away = kMarkRadius + 4; away <= kFurthest; away += kRing)
    for (int i = 0; i < kDirections; ++i) {
      // Right, left, right below, right above, and so on.
      const double turn = (i % 2) * std::numbers::pi;
      const int steps = (i / 2 + 1) / 2, sense = (i / 2) % 2 == 0 ? 1 : -1;
      const double angle = turn + sense * steps * 2 * std::numbers::pi / kDirections;
      const double cx = x + away * std::cos(angle), cy = y + away * std::sin(angle);
      // Puts the point of the box that is nearest to the mark on the ring.
      const Box box{cx - w * 0.5 * (1 - std::cos(angle)), cy - h * 0.5 * (1 - std::sin(angle)), w,
                    h};
      if (!IsFree(box)) continue;
      taken_.push_back(box);
      if (away > 2 * kMarkRadius + 4)
        Put("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#bbbbbb\" "
            "stroke-width=\"0.6\"/>\n",
            x + kMarkRadius * std::cos(angle), y + kMarkRadius * std::sin(angle), cx, cy);
      // The side of the text that is exact is the one next to the mark.
      constexpr double kBeside = 0.3;
      const double side = std::cos(angle);
      const double at = side > kBeside ? box.x : side < -kBeside ? box.x + w : box.x + w / 2;
      // A white outline keeps a label readable over a line.
      labels_ += fmt::format(
          "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\" "
          "stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
          at, box.y + 11, kLabelFont,
          side > kBeside    ? "start"
          : side < -kBeside ? "end"
                            : "middle",
          ColourOf(mark.series), XmlText(mark.words));
      return;
    }
  ++unlabelled_;
}

}  // namespace

std::string SpeedErrorSvg(const PlotWords& words, const std::vector<PlotMark>& marks) {
  return Plot(words, marks).Draw();
}

}  // namespace arthro::app
