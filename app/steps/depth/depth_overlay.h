// The panorama with a layer of colours that says where each depth comes from, how certain it is or
// how far the tissue is away, and the legend of the colours.
#pragma once

#include "app/steps/depth/depth_board.h"

namespace arthro::app {

struct DrawnLayer {
  ColourImage picture;  // the panorama, small enough for the board
  MapLegend legend;
};
DrawnLayer DrawLayer(const authoring::Document& document, MapLayer layer);

// Standard error at the high end of its colours, m.
inline constexpr double kMostShownSigma = 2e-3;

}  // namespace arthro::app
