// Curves over one axis as SVG, readable in print: values over time, or a path seen from one side.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arthro::app {

struct Curve {
  std::string name;                               // in the legend; empty: not listed
  std::vector<std::pair<double, double>> points;  // a point that is not finite parts the curve
};

// Values at which something is drawn across the plot.
struct PlotLine {
  double at = 0;
  std::string words;
};

struct LinePlot {
  std::string title, x, y;  // titles of the plot and of the axes
  std::vector<Curve> curves = {};
  std::vector<PlotLine> limits = {};     // across, at values of y
  std::vector<PlotLine> divisions = {};  // upright, at values of x
  bool has_equal_scales = false;         // one length on both axes is one length in the plot
  bool begins_at_zero = false;           // the values of y are not negative
  std::optional<double> most_y = {};     // the axis reaches at least so far
  double width = 720, height = 240;      // px
};

// Without a point the plot says that there is none.
std::string LinePlotSvg(const LinePlot& plot);

// A curve with at most `most` points: of each stretch its first, least, largest and last value.
Curve Thinned(const Curve& curve, std::size_t most);

}  // namespace arthro::app
