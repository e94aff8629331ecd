// Pixels of a map under a stroke, in square tiles, so that work and memory grow with the stroke and
// not with the map. Tiles lie on a fixed grid, hence do not depend on threads. Distances in px.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "authoring/depth/strokes/depth_stroke.h"
#include "simulation/scene/pixel_bounds.h"

namespace arthro::authoring {

struct StrokeTile {
  static constexpr int kSide = 64;  // px
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<float> weight;  // 0 to 1, row by row
  PixelBounds box;            // around the pixels with a weight
  int touched = 0;            // number of these pixels

  float WeightAt(int column, int row) const {
    return weight[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

// Footprint of a stroke that may grow by further points; a new piece changes only the tiles that it
// reaches. The part outside the map is left out.
class StrokeFootprint {
 public:
  using Place = std::pair<int, int>;  // row and column of a tile

  // `stroke`: radius and weights; its points are those that are added.
  StrokeFootprint(DepthStroke stroke, int width, int height);

  // Adds points of the line, in shares of the panorama's width, and returns the places of the tiles
  // that may have changed, in row order.
  std::vector<Place> Add(std::span<const glm::dvec2> points);

  double radius() const { return radius_; }  // px
  // Centre of the top left pixel at the origin, px.
  const std::vector<glm::dvec2>& points() const { return points_; }
  int width() const { return width_; }
  int height() const { return height_; }

  // Tiles with a weight above 0, in row order.
  std::vector<const StrokeTile*> Tiles() const;
  // Those of them at these places.
  std::vector<const StrokeTile*> TilesAt(std::span<const Place> places) const;

 private:
  struct Entry {
    StrokeTile tile;
    std::vector<double> distance2;  // px², of each pixel from the line
  };
  void Measure(Entry& entry, std::span<const std::size_t> segments) const;

  DepthStroke stroke_;
  double radius_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<glm::dvec2> points_;
  std::map<Place, Entry> entries_;
};

// Box around the pixels with a weight, and their number.
PixelBounds BoxOf(std::span<const StrokeTile* const> tiles);
int TouchedBy(std::span<const StrokeTile* const> tiles);

// Nearest point of the stroke's line.
struct LineFoot {
  glm::dvec2 point{0.0};
  glm::dvec2 normal{0.0};    // unit, of its segment, to its right with y down
  double distance = 0;       // px
  bool is_past_end = false;  // beyond the first or the last end of the line
};
LineFoot NearestOnLine(const std::vector<glm::dvec2>& points, const glm::dvec2& at);

}  // namespace arthro::authoring
