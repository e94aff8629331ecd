#include "authoring/depth/strokes/stroke_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "authoring/depth/grey_plane.h"

namespace arthro::authoring {
namespace {

// Indices of segments by tile (row, column). A single point is one segment without a length.
using SegmentsByTile = std::map<StrokeFootprint::Place, std::vector<std::size_t>>;

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

// Segments from the index `first` on.
SegmentsByTile SegmentsFrom(std::size_t first, const std::vector<glm::dvec2>& points, double radius,
                            int width, int height) {
  SegmentsByTile tiles;
  const std::size_t count = points.size() > 1 ? points.size() - 1 : points.size();
  for (std::size_t i = first; i < count; ++i) {
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

StrokeFootprint::StrokeFootprint(DepthStroke stroke, int width, int height)
    : stroke_(std::move(stroke)), radius_(stroke_.radius * width), width_(width), height_(height) {
  stroke_.points.clear();
}

std::vector<StrokeFootprint::Place> StrokeFootprint::Add(std::span<const glm::dvec2> points) {
  std::vector<Place> changed;
  if (points.empty() || width_ <= 0 || height_ <= 0) return changed;
  const std::size_t before = points_.size();
  for (const glm::dvec2& point : points)
    points_.push_back(point * static_cast<double>(width_) - 0.5);
  // A first point alone was measured as a segment without a length, which the first real one
  // replaces.
  if (before == 1) entries_.clear();
  const SegmentsByTile segments =
      SegmentsFrom(before < 2 ? 0 : before - 1, points_, radius_, width_, height_);

  std::vector<std::pair<Entry*, const std::vector<std::size_t>*>> work;
  for (const auto& [place, of_tile] : segments) {
    Entry& entry = entries_[place];
    StrokeTile& tile = entry.tile;
    tile.x = place.second * StrokeTile::kSide;
    tile.y = place.first * StrokeTile::kSide;
    tile.width = std::min(StrokeTile::kSide, width_ - tile.x);
    tile.height = std::min(StrokeTile::kSide, height_ - tile.y);
    work.emplace_back(&entry, &of_tile);
    changed.push_back(place);
  }
  ForStripsOfRows(static_cast<int>(work.size()), [&](int first, int last) {
    for (int t = first; t < last; ++t) {
      const auto& [entry, of_tile] = work[static_cast<std::size_t>(t)];
      Measure(*entry, *of_tile);
    }
  });
  return changed;
}

void StrokeFootprint::Measure(Entry& entry, std::span<const std::size_t> segments) const {
  StrokeTile& tile = entry.tile;
  const auto size = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
  entry.distance2.resize(size, std::numeric_limits<double>::infinity());
  tile.weight.resize(size);
  tile.box = {};
  tile.touched = 0;
  std::size_t i = 0;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x, ++i) {
      double& distance2 = entry.distance2[i];
      for (const std::size_t segment : segments) {
        const glm::dvec2 off =
            glm::dvec2(x, y) - FootOn(points_[segment], EndOf(points_, segment), glm::dvec2(x, y));
        distance2 = std::min(distance2, glm::dot(off, off));
      }
      const double share = std::sqrt(distance2) / radius_;
      tile.weight[i] = static_cast<float>(StrokeWeight(stroke_, share));
      if (!(tile.weight[i] > 0)) continue;
      ++tile.touched;
      tile.box = Joined(tile.box, {x, y, x + 1, y + 1});
    }
}

std::vector<const StrokeTile*> StrokeFootprint::Tiles() const {
  std::vector<const StrokeTile*> tiles;
  for (const auto& [place, entry] : entries_)
    if (entry.tile.touched > 0) tiles.push_back(&entry.tile);
  return tiles;
}

std::vector<const StrokeTile*> StrokeFootprint::TilesAt(std::span<const Place> places) const {
  std::vector<const StrokeTile*> tiles;
  for (const Place& place : places)
    if (const auto at = entries_.find(place); at != entries_.end() && at->second.tile.touched > 0)
      tiles.push_back(&at->second.tile);
  return tiles;
}

PixelBounds BoxOf(std::span<const StrokeTile* const> tiles) {
  PixelBounds box;
  for (const StrokeTile* tile : tiles) box = Joined(box, tile->box);
  return box;
}

int TouchedBy(std::span<const StrokeTile* const> tiles) {
  int touched = 0;
  for (const StrokeTile* tile : tiles) touched += tile->touched;
  return touched;
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
