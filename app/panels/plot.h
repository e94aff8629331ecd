// A figure of curves over one axis, drawn by Dear ImGui's lists: axes with round numbers, bands of
// values, limits, marks, and one position that a click sets.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/fixed_window.h"
#include "app/panels/widgets.h"

namespace arthro::app {

inline constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();  // breaks a curve

// Step of 1, 2 or 5 times a power of ten that divides the span into at most `most` parts.
double RoundStep(double span, int most);

struct PlotCurve {
  std::vector<ImVec2> points;  // in units of the axes; a y of NaN breaks the curve
  unsigned colour = kAccent;
  bool has_dots = false;
};

struct Plot {
  std::string title;             // above it, with the unit
  double left = 0, right = 1;    // x axis
  double low = 0, high = 1;      // y axis
  std::string x_unit;            // behind the numbers of the x axis
  bool is_equal = false;         // one scale for both axes
  bool has_whole_steps = false;  // the x axis counts
  std::vector<PlotCurve> curves;
  std::vector<std::pair<double, double>> bands;    // values of y, shaded
  std::vector<double> limits;                      // values of y, red lines
  std::vector<std::pair<double, unsigned>> marks;  // positions on x, with their colours
  std::optional<double> cursor;                    // position on x
};

// Widens the axes until every curve fits, with a little room.
void FitAxes(Plot& plot);

// Draws it; returns the position on x that is held with the mouse. Records its title.
std::optional<double> DrawPlot(Ui& ui, const Plot& plot, const Area& area);

}  // namespace arthro::app
