// Speed against error as a picture: one mark per variant, time to the right, error upwards, both
// logarithmic, so that better is down and left. SVG, readable in print.
#pragma once

#include <string>
#include <vector>

namespace arthro::app {

struct PlotMark {
  std::string series;       // colour and legend
  std::string words;        // beside the mark
  double milliseconds = 0;  // x
  double error = 0;         // y; NaN: no result was right, the mark is on the top edge
  double share = 1;         // opacity of the filling, 0 to 1
};

struct PlotWords {
  std::string title, x, y;  // titles of the plot and of the axes
  std::string share;        // meaning of the filling; may be empty
  std::string reference;    // to which the errors refer
};

// Keeps the order in which the series first appear. Labels overlap neither one another nor a mark:
// they move away from their mark along a thin line, and are counted in the plot where there is no
// room. Without marks the axes are drawn alone.
std::string SpeedErrorSvg(const PlotWords& words, const std::vector<PlotMark>& marks);

}  // namespace arthro::app
