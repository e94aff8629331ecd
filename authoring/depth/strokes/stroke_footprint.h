// Pixels of a map under a stroke, in square tiles, so that work and memory grow with the stroke and
// not with the map. Tiles lie on a fixed grid, hence do not depend on threads. Distances in px.
#pragma once

#include <cstddef>
#include <vector>

#include "authoring/depth/strokes/depth_stroke.h"

namespace arthro::authoring {

struct StrokeTile {
  static constexpr int kSide = 64;  // px
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<float> weight;  // 0 to 1, row by row

  float WeightAt(int column, int row) const {
    return weight[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

// Half-open rectangle of pixels; empty: nothing.
struct PixelBounds {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool is_empty() const { return left >= right || top >= bottom; }
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};
// Smallest box around both.
PixelBounds Joined(const PixelBounds& a, const PixelBounds& b);
// `margin` px larger on each side, within a map of that size.
PixelBounds Grown(const PixelBounds& box, int margin, int width, int height);

struct StrokeFootprint {
  double radius = 0;               // px
  std::vector<glm::dvec2> points;  // px, centre of the top left pixel at the origin
  std::vector<StrokeTile> tiles;   // those with a weight above 0, in row order
  PixelBounds box;                 // around the pixels with a weight
  int touched = 0;                 // number of these pixels
};

// Footprint on a map of that size; the part outside the map is left out.
StrokeFootprint FootprintOf(const DepthStroke& stroke, int width, int height);

// Nearest point of the stroke's line.
struct LineFoot {
  glm::dvec2 point{0.0};
  glm::dvec2 normal{0.0};    // unit, of its segment, to its right with y down
  double distance = 0;       // px
  bool is_past_end = false;  // beyond the first or the last end of the line
};
LineFoot NearestOnLine(const std::vector<glm::dvec2>& points, const glm::dvec2& at);

}  // namespace arthro::authoring
