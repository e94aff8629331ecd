#include "authoring/depth/strokes/stroke_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {
namespace {

// Indices of segments by tile (row, column). A single point is one segment without a length.
using SegmentsByTile = std::map<std::pair<int, int>, std::vector<std::size_t>>;

glm::dvec2 EndOf(const std::vector<glm::dvec2>& points, std::size_t segment) {
  return points[std::min(segment + 1, points.size() - 1)];
}

glm::dvec2 FootOn(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& at) {
  const glm::dvec2 along = to - from;
  const double length2 = glm::dot(along, along);
  if (!(length2 > 0)) return from;
  return from + std::clamp(glm::dot(at - from, along) / length2, 0.0, 1.0) * along;
}

int TileOf(double pixel, int size) {
  return static_cast<int>(std::floor(std::clamp(pixel, 0.0, size - 1.0) / StrokeTile::kSide));
}

SegmentsByTile SegmentsOf(const std::vector<glm::dvec2>& points, double radius, int width,
                          int height) {
  SegmentsByTile tiles;
  const std::size_t count = points.size() > 1 ? points.size() - 1 : points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 from = points[i], to = EndOf(points, i);
    const glm::dvec2 low = glm::min(from, to) - radius, high = glm::max(from, to) + radius;
    if (!(high.x >= 0 && high.y >= 0 && low.x <= width - 1 && low.y <= height - 1)) continue;
    for (int row = TileOf(low.y, height); row <= TileOf(high.y, height); ++row)
      for (int column = TileOf(low.x, width); column <= TileOf(high.x, width); ++column)
        tiles[{row, column}].push_back(i);
  }
  return tiles;
}

}  // namespace

PixelBounds Joined(const PixelBounds& a, const PixelBounds& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

PixelBounds Grown(const PixelBounds& box, int margin, int width, int height) {
  return {std::max(0, box.left - margin), std::max(0, box.top - margin),
          std::min(width, box.right + margin), std::min(height, box.bottom + margin)};
}

StrokeFootprint FootprintOf(const DepthStroke& stroke, int width, int height) {
  StrokeFootprint footprint;
  footprint.radius = stroke.radius * width;
  for (const glm::dvec2& point : stroke.points)
    footprint.points.push_back(point * static_cast<double>(width) - 0.5);
  if (footprint.points.empty() || width <= 0 || height <= 0) return footprint;

  const SegmentsByTile segments = SegmentsOf(footprint.points, footprint.radius, width, height);
  std::vector<const SegmentsByTile::value_type*> entries;
  for (const auto& entry : segments) entries.push_back(&entry);
  std::vector<StrokeTile> tiles(entries.size());
  std::vector<PixelBounds> boxes(entries.size());
  std::vector<int> touched(entries.size(), 0);
  ForStripsOfRows(static_cast<int>(entries.size()), [&](int first, int last) {
    for (int t = first; t < last; ++t) {
      const auto at = static_cast<std::size_t>(t);
      StrokeTile& tile = tiles[at];
      tile.x = entries[at]->first.second * StrokeTile::kSide;
      tile.y = entries[at]->first.first * StrokeTile::kSide;
      tile.width = std::min(StrokeTile::kSide, width - tile.x);
      tile.height = std::min(StrokeTile::kSide, height - tile.y);
      tile.weight.reserve(static_cast<std::size_t>(tile.width) *
                          static_cast<std::size_t>(tile.height));
      for (int y = tile.y; y < tile.y + tile.height; ++y)
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
          double distance2 = std::numeric_limits<double>::infinity();
          for (const std::size_t i : entries[at]->second) {
            const glm::dvec2 off =
                glm::dvec2(x, y) -
                FootOn(footprint.points[i], EndOf(footprint.points, i), glm::dvec2(x, y));
            distance2 = std::min(distance2, glm::dot(off, off));
          }
          const double share = std::sqrt(distance2) / footprint.radius;
          const auto weight = static_cast<float>(StrokeWeight(stroke, share));
          tile.weight.push_back(weight);
          if (!(weight > 0)) continue;
          ++touched[at];
          boxes[at] = Joined(boxes[at], {x, y, x + 1, y + 1});
        }
    }
  });
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (touched[i] == 0) continue;
    footprint.touched += touched[i];
    footprint.box = Joined(footprint.box, boxes[i]);
    footprint.tiles.push_back(std::move(tiles[i]));
  }
  return footprint;
}

LineFoot NearestOnLine(const std::vector<glm::dvec2>& points, const glm::dvec2& at) {
  LineFoot nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec2 along = points[i + 1] - points[i];
    const double length = glm::length(along);
    if (!(length > 0)) continue;
    const glm::dvec2 foot = FootOn(points[i], points[i + 1], at);
    const double distance = glm::distance(foot, at);
    if (distance >= nearest.distance) continue;
    const double share = glm::dot(at - points[i], along) / (length * length);
    nearest = {foot, glm::dvec2(-along.y, along.x) / length, distance,
               (i == 0 && share < 0) || (i + 2 == points.size() && share > 1)};
  }
  return nearest;
}

}  // namespace arthro::authoring
