#include "authoring/depth/strokes/mend_depth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "authoring/depth/strokes/stroke_effect.h"
#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"

namespace arthro::authoring {

StrokeReport ApplyStroke(const DepthStroke& stroke, const MendedScene& scene, MendedDepth& depth) {
  StrokeReport report;
  StrokeFootprint footprint(stroke, depth.relief.width, depth.relief.height);
  footprint.Add(stroke.points);
  const std::vector<const StrokeTile*> tiles = footprint.Tiles();
  report.touched = TouchedBy(tiles);
  report.box = BoxOf(tiles);
  for (const StrokeTile* tile : tiles) report.read += tile->width * tile->height;
  if (tiles.empty() || stroke.kind == StrokeKind::kKeep) return report;
  if (stroke.kind == StrokeKind::kMask) {
    CloseMasked(tiles, scene, depth);
    return report;
  }
  CheckPicture(stroke, scene, depth.relief);
  StrokeSums sums;
  if (HasSums(stroke.kind))
    for (const StrokeTile* tile : tiles) sums.Add(SumsOf(stroke, scene, depth.relief, *tile));
  ApplyToTiles(stroke, scene, footprint, sums, tiles, depth.relief, depth);
  return report;
}

void ReplayStrokes(std::span<const DepthStroke> strokes, const MendedScene& scene,
                   MendedDepth& depth) {
  for (const DepthStroke& stroke : strokes)
    if (!IsMask(stroke)) ApplyStroke(stroke, scene, depth);
}

std::vector<DepthMark> MarksOf(std::span<const DepthStroke> strokes, int width, int height) {
  std::vector<DepthMark> marks;
  for (const DepthStroke& stroke : strokes) {
    if (!IsMask(stroke)) continue;
    marks.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 DepthMark::kNone);
    const DepthMark mark = stroke.kind == StrokeKind::kMask ? DepthMark::kMasked : DepthMark::kKept;
    StrokeFootprint footprint(stroke, width, height);
    footprint.Add(stroke.points);
    for (const StrokeTile* tile : footprint.Tiles())
      for (int row = 0; row < tile->height; ++row)
        for (int column = 0; column < tile->width; ++column)
          if (tile->WeightAt(column, row) > 0)
            marks[static_cast<std::size_t>(tile->y + row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(tile->x + column)] = mark;
  }
  return marks;
}

void CheckStrokes(std::span<const DepthStroke> strokes) {
  int number = 0;
  for (const DepthStroke& stroke : strokes) {
    ++number;
    try {
      CheckOptions(stroke);
    } catch (const Error& error) {
      throw Error(Code::kBadArgument, fmt::format("stroke {}: {}", number, error.what()));
    }
    const bool is_finite = std::all_of(
        stroke.points.begin(), stroke.points.end(),
        [](const glm::dvec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); });
    if (stroke.points.empty() || !is_finite)
      throw Error(
          Code::kBadArgument,
          fmt::format("stroke {} has {}; give at least one point inside the picture", number,
                      stroke.points.empty() ? "no points"
                                            : "a point that is no "
                                              "number"));
  }
}

}  // namespace arthro::authoring
