#include "authoring/depth/strokes/growing_stroke.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>

#include "simulation/scene/files/loaded_scene.h"

namespace arthro::authoring {
namespace {

template <class Map, class Value>
void CopyRows(const Map& from, const StrokeTile& tile, std::vector<Value> Map::*values, Map& to) {
  if (to.empty()) return;
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * to.width + tile.x;
    std::copy_n((from.*values).begin() + first, tile.width, (to.*values).begin() + first);
  }
}

// Far outside the map, px: there is nothing to change, and no place in an int.
constexpr double kFar = 1e8;

// Pixels that the line can change from its point `first` on.
PixelBounds ReachedFrom(std::size_t first, const StrokeFootprint& footprint) {
  PixelBounds box;
  const double radius = footprint.radius();
  for (std::size_t i = first; i < footprint.points().size(); ++i) {
    const glm::dvec2 low = glm::floor(footprint.points()[i] - radius),
                     high = glm::ceil(footprint.points()[i] + radius);
    const auto pixel = [](double at) { return static_cast<int>(std::clamp(at, -kFar, kFar)); };
    box = Joined(box, {pixel(low.x), pixel(low.y), pixel(high.x) + 1, pixel(high.y) + 1});
  }
  return box;
}

PixelBounds Common(const PixelBounds& a, const PixelBounds& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

StrokeFootprint::Place PlaceOf(const StrokeTile& tile) {
  return {tile.y / StrokeTile::kSide, tile.x / StrokeTile::kSide};
}

}  // namespace

GrowingStroke::GrowingStroke(DepthStroke stroke, std::shared_ptr<const ColourImage> panorama,
                             const Projection& projection, double radius, MendedDepth before)
    : stroke_(std::move(stroke)),
      panorama_(std::move(panorama)),
      projection_(projection),
      radius_(radius),
      before_(std::move(before)),
      depth_(before_),
      footprint_(stroke_, before_.relief.width, before_.relief.height) {}

void GrowingStroke::Restore(std::span<const StrokeTile* const> tiles) {
  for (const StrokeTile* tile : tiles) {
    CopyRows(before_.relief, *tile, &DepthMap::relief, depth_.relief);
    CopyRows(before_.sigma, *tile, &DepthMap::relief, depth_.sigma);
    CopyRows(before_.origin, *tile, &OriginMap::origin, depth_.origin);
  }
}

StrokeReport GrowingStroke::Add(std::span<const glm::dvec2> points) {
  const MendedScene scene{OrEmpty(panorama_), projection_, radius_};
  CheckPicture(stroke_, scene, before_.relief);
  const std::size_t count = footprint_.points().size();
  const std::vector<StrokeFootprint::Place> places = footprint_.Add(points);
  std::vector<const StrokeTile*> tiles = footprint_.TilesAt(places);

  StrokeSums sums;
  if (HasSums(stroke_.kind)) {
    for (const StrokeTile* tile : tiles)
      sums_[PlaceOf(*tile)] = SumsOf(stroke_, scene, before_.relief, *tile);
    for (const auto& [place, of_tile] : sums_) sums.Add(of_tile);
  }
  const bool is_whole = HasSums(stroke_.kind) || stroke_.kind == StrokeKind::kMask;
  if (is_whole) tiles = footprint_.Tiles();

  StrokeReport report;
  report.touched = TouchedBy(tiles);
  report.box = BoxOf(tiles);
  if (!is_whole)
    report.box = Common(report.box, ReachedFrom(count > 0 ? count - 1 : 0, footprint_));
  if (report.box.is_empty()) report.box = {};
  for (const StrokeTile* tile : tiles) report.read += tile->width * tile->height;
  if (tiles.empty() || stroke_.kind == StrokeKind::kKeep) return report;
  Restore(tiles);
  if (stroke_.kind == StrokeKind::kMask)
    CloseMasked(tiles, scene, depth_);
  else
    ApplyToTiles(stroke_, scene, footprint_, sums, tiles, before_.relief, depth_);
  return report;
}

}  // namespace arthro::authoring
