// Effect of strokes on a depth map. A stroke reads and writes only the tiles that it touches, and
// the same map and strokes give the same bytes for any number of threads. Relief h over the sphere
// of the backdrop, m, NaN where it is unknown; frame: portal.
//
// With weight w of a pixel, amount a and strength s, a stroke gives
//   raise, lower   h ± w a
//   smooth         h + w s (mean of h over half the radius − h)
//   flatten        h + w s (h of the plane − h); plane n·x = d by least squares of 1/r = (n/d)·dir
//   brightness     h + w s (mean of h + a (g − mean of g) − h), g: luminance from 0 to 1
//   edge           h + w s (h at the rim of the own side of the line − h)
//   unknown        NaN where w ≥ 1/2
//   mask           a membrane over all pixels with a weight (relief/editing/wrong_cells.h)
// Unknown pixels stay unknown and do not count in means.
#pragma once

#include <span>
#include <vector>

#include "authoring/depth/depth_filter.h"
#include "authoring/depth/strokes/stroke_footprint.h"
#include "simulation/scene/image.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

struct MendedDepth {
  DepthMap relief;
  DepthMap sigma;    // standard error, m; empty: not known
  OriginMap origin;  // empty: made from brightness throughout
};

// Surroundings of a stroke: the panorama of the map's size (brightness) and its place in space.
struct MendedScene {
  const ColourImage& panorama;
  const Projection& projection;
  double radius = 0;  // m, of the backdrop
};

struct StrokeReport {
  int touched = 0;  // pixels with a weight
  int read = 0;     // pixels of the tiles that were computed
  PixelBounds box;  // around the touched pixels
};

// Applies one stroke. A measured map states which pixels are no longer measured, and their standard
// error grows by the change; smoothing an estimated map lowers its noise. `keep` does nothing.
StrokeReport ApplyStroke(const DepthStroke& stroke, const MendedScene& scene, MendedDepth& depth);

// Applies the strokes to a map that was made anew by an estimator that honoured their masks.
void ReplayStrokes(std::span<const DepthStroke> strokes, const MendedScene& scene,
                   MendedDepth& depth);

// Marks for the estimator, one per pixel; empty where no stroke is a mask. Later strokes prevail.
std::vector<DepthMark> MarksOf(std::span<const DepthStroke> strokes, int width, int height);

// Throws Error(kBadArgument) for a field outside its range, no point, or a point that is no number.
void CheckStrokes(std::span<const DepthStroke> strokes);

}  // namespace arthro::authoring
