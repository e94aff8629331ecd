#include "app/bench/speed_error_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace arthro::app {
namespace {

constexpr double kWidth = 960, kHeight = 620;
constexpr double kLeft = 76, kRight = 24, kTop = 84, kBottom = 64;
// Told apart with every common kind of colour blindness [Okabe & Ito 2008].
constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};

std::string Escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    c == '&' ? out += "&amp;" : c == '<' ? out += "&lt;" : c == '>' ? out += "&gt;" : out += c;
  return out;
}

// A logarithmic axis whose ends are 1, 2 or 5 times a power of ten.
struct Axis {
  double low = 1, high = 10, from = 0, to = 1;  // values; pixels
  double At(double value) const {
    const double share = std::log(value / low) / std::log(high / low);
    return from + std::clamp(share, 0.0, 1.0) * (to - from);
  }
};

std::vector<double> Ticks(double low, double high) {
  std::vector<double> ticks;
  for (int e = -6; e <= 9; ++e)
    for (const double m : {1.0, 2.0, 5.0})
      if (const double t = m * std::pow(10.0, e); t >= low * 0.999 && t <= high * 1.001)
        ticks.push_back(t);
  return ticks;
}

Axis AxisOver(double least, double most, double from, double to) {
  const std::vector<double> all = Ticks(1e-6, 5e9);
  Axis axis{all.front(), all.back(), from, to};
  for (const double t : all) {
    if (t <= least * 0.9) axis.low = t;
    if (t >= most * 1.1) {
      axis.high = t;
      break;
    }
  }
  return axis;
}

struct Box {
  double x, y, w, h;
  bool Meets(const Box& o) const {
    return x < o.x + o.w && o.x < x + w && y < o.y + o.h && o.y < y + h;
  }
};

}  // namespace

std::string SpeedErrorSvg(const PlotWords& words, const std::vector<PlotMark>& marks) {
  double least_x = 10, most_x = 100, least_y = 0.1, most_y = 10;
  bool is_first_x = true, is_first_y = true;
  for (const PlotMark& mark : marks) {
    if (std::isfinite(mark.milliseconds) && mark.milliseconds > 0) {
      least_x = is_first_x ? mark.milliseconds : std::min(least_x, mark.milliseconds);
      most_x = is_first_x ? mark.milliseconds : std::max(most_x, mark.milliseconds);
      is_first_x = false;
    }
    if (std::isfinite(mark.error) && mark.error > 0) {
      least_y = is_first_y ? mark.error : std::min(least_y, mark.error);
      most_y = is_first_y ? mark.error : std::max(most_y, mark.error);
      is_first_y = false;
    }
  }
  const Axis x = AxisOver(least_x, most_x, kLeft, kWidth - kRight);
  const Axis y = AxisOver(least_y, most_y, kHeight - kBottom, kTop + 28);

  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" font-family=\"DejaVu Sans, sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n"
      "<text x=\"{2:g}\" y=\"28\" font-size=\"17\" fill=\"#111111\">{3}</text>\n",
      kWidth, kHeight, kLeft, Escaped(words.title));
  const auto out = std::back_inserter(svg);

  // Grid, ticks and names of the axes.
  for (const double t : Ticks(x.low, x.high))
    fmt::format_to(out,
                   "<path d=\"M{0:.1f} {1:g}V{2:g}\" stroke=\"#e4e4e4\"/><text x=\"{0:.1f}\" "
                   "y=\"{3:g}\" text-anchor=\"middle\" fill=\"#444444\">{4:g}</text>\n",
                   x.At(t), kTop, kHeight - kBottom, kHeight - kBottom + 18, t);
  for (const double t : Ticks(y.low, y.high))
    fmt::format_to(out,
                   "<path d=\"M{0:g} {1:.1f}H{2:g}\" stroke=\"#e4e4e4\"/><text x=\"{3:g}\" "
                   "y=\"{4:.1f}\" text-anchor=\"end\" fill=\"#444444\">{5:g}</text>\n",
                   kLeft, y.At(t), kWidth - kRight, kLeft - 8, y.At(t) + 4, t);
  fmt::format_to(
      out,
      "<path d=\"M{0:g} {1:g}V{2:g}H{3:g}\" fill=\"none\" stroke=\"#222222\"/>\n"
      "<text x=\"{4:g}\" y=\"{5:g}\" text-anchor=\"middle\" fill=\"#111111\">{6}</text>\n"
      "<text transform=\"translate(20 {7:g}) rotate(-90)\" text-anchor=\"middle\" "
      "fill=\"#111111\">{8}</text>\n",
      kLeft, kTop, kHeight - kBottom, kWidth - kRight, (kLeft + kWidth - kRight) / 2,
      kHeight - 18.0, Escaped(words.x), (kTop + kHeight - kBottom) / 2, Escaped(words.y));
  fmt::format_to(out,
                 "<text x=\"{:g}\" y=\"{:g}\" text-anchor=\"end\" fill=\"#666666\">"
                 "{}</text>\n",
                 kWidth - kRight, 28.0, Escaped(words.share));

  // Legend in a row, in the order of first appearance.
  std::vector<std::string> series;
  for (const PlotMark& mark : marks)
    if (std::find(series.begin(), series.end(), mark.series) == series.end())
      series.push_back(mark.series);
  const auto colour = [&](const std::string& name) {
    const auto at = std::find(series.begin(), series.end(), name) - series.begin();
    return kColours[static_cast<std::size_t>(at) % kColours.size()];
  };
  double at = kLeft;
  for (const std::string& name : series) {
    fmt::format_to(
        out,
        "<circle cx=\"{:.1f}\" cy=\"52\" r=\"6\" fill=\"{}\"/><text x=\"{:.1f}\" y=\"56\" "
        "fill=\"#111111\">{}</text>\n",
        at + 6, colour(name), at + 18, Escaped(name));
    at += 36 + 7.4 * static_cast<double>(name.size());
  }

  // Marks, then words where they meet no other words or mark.
  std::vector<Box> taken;
  const auto place = [&](const PlotMark& mark) {
    return std::pair{x.At(mark.milliseconds),
                     std::isfinite(mark.error) ? y.At(mark.error) : kTop + 8};
  };
  for (const PlotMark& mark : marks) {
    const auto [px, py] = place(mark);
    fmt::format_to(out,
                   "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"7\" fill=\"{2}\" "
                   "fill-opacity=\"{3:.2f}\" stroke=\"{2}\" stroke-width=\"1.5\"/>\n",
                   px, py, colour(mark.series), std::clamp(mark.share, 0.0, 1.0));
    taken.push_back({px - 7, py - 7, 14, 14});
  }
  for (const PlotMark& mark : marks) {
    const auto [px, py] = place(mark);
    const double w = 6.4 * static_cast<double>(mark.words.size());
    const std::array<Box, 8> places = {
        Box{px + 11, py - 7, w, 14},     Box{px - 11 - w, py - 7, w, 14},
        Box{px - w / 2, py - 24, w, 14}, Box{px - w / 2, py + 10, w, 14},
        Box{px + 9, py - 22, w, 14},     Box{px + 9, py + 8, w, 14},
        Box{px - 9 - w, py - 22, w, 14}, Box{px - 9 - w, py + 8, w, 14}};
    const auto fits = [&](const Box& box) {
      return box.x > kLeft && box.x + box.w < kWidth - 4 &&
             std::none_of(taken.begin(), taken.end(),
                          [&](const Box& other) { return box.Meets(other); });
    };
    const auto free = std::find_if(places.begin(), places.end(), fits);
    if (free == places.end()) continue;  // crowded out; the table has its row
    taken.push_back(*free);
    fmt::format_to(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" fill=\"{}\">{}</text>\n",
                   free->x, free->y + 11, colour(mark.series), Escaped(mark.words));
  }
  return svg + "</svg>\n";
}

}  // namespace arthro::app
