// Speed against error as a picture: one mark a chain, processor time to the right, error upwards,
// both logarithmic, so that better is down and left. SVG, readable in print.
#pragma once

#include <string>
#include <vector>

namespace arthro::app {

struct PlotMark {
  std::string series;       // colour and legend
  std::string words;        // beside the mark
  double milliseconds = 0;  // of processor time a frame
  double error = 0;         // NaN: nothing was right; it stands on the top edge
  double share = 1;         // 0 to 1: how full the mark is drawn
};

struct PlotWords {
  std::string title, x, y, share;  // share: what the filling says, beside the title
};

// Series keep the order of their first mark. Without marks: the axes alone.
std::string SpeedErrorSvg(const PlotWords& words, const std::vector<PlotMark>& marks);

}  // namespace arthro::app
