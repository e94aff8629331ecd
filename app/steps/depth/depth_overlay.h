// The panorama with a layer of colours that says where each depth comes from, how certain it is or
// how far the tissue is away, and the legend of the colours.
#pragma once

#include "app/steps/depth/depth_board.h"
#include "authoring/depth/depth_preview.h"

namespace arthro::app {

struct DrawnLayer {
  ColourImage picture;  // the panorama, small enough for the board
  MapLegend legend;
};
DrawnLayer DrawLayer(const authoring::Document& document, MapLayer layer);

// A coarse copy of the map, one value per `stride` pixels of the panorama, and the picture's part.
struct CoarseMap {
  const DepthMap& depth;
  const ColourImage& picture;
  int stride = 1;
};
// Coarse pixels to each side over which the shape takes its slopes.
inline constexpr int kShapeReach = 4;
// The layer on a box of the coarse map.
ColourImage DrawCoarse(const authoring::Document& document, MapLayer layer, const CoarseMap& coarse,
                       const PixelBounds& box);

// The grey that the estimator begins with, and the relief that it makes before any stroke, near
// white.
ColourImage GreyPicture(const ColourImage& panorama, const authoring::DepthOptions& options);
ColourImage FilteredPicture(const authoring::DepthPreview& pyramid,
                            const authoring::Document& document);

// Standard error at the high end of its colours, m.
inline constexpr double kMostShownSigma = 2e-3;

}  // namespace arthro::app
