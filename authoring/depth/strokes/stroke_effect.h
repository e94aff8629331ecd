// Effect of a stroke on the tiles of its footprint, as mend_depth.h states it. A tile's new heights
// depend on the relief before the stroke, on the line and on sums over all tiles, so that any part
// of the tiles can be made anew.
#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "authoring/depth/strokes/mend_depth.h"

namespace arthro::authoring {

// Fit of flatten and brightness, whose target is one for the whole stroke.
struct StrokeSums {
  glm::dmat3 normal{0.0};  // normal matrix of the plane's fit
  glm::dvec3 right{0.0};
  int count = 0;
  double weights = 0, heights = 0, greys = 0;
  void Add(const StrokeSums& other);
};
bool HasSums(StrokeKind kind);
StrokeSums SumsOf(const DepthStroke& stroke, const MendedScene& scene, const DepthMap& before,
                  const StrokeTile& tile);

// Writes the new heights of `tiles`. `before`: the relief without the stroke; it may be that of
// `depth`, whose other tiles are then as they were before the stroke or no tiles of the stroke.
void ApplyToTiles(const DepthStroke& stroke, const MendedScene& scene,
                  const StrokeFootprint& footprint, const StrokeSums& sums,
                  std::span<const StrokeTile* const> tiles, const DepthMap& before,
                  MendedDepth& depth);

// Closes the surface over all tiles of a mask, within their box and a rim of one pixel.
void CloseMasked(std::span<const StrokeTile* const> tiles, const MendedScene& scene,
                 MendedDepth& depth);

// Throws Error(kBadArgument) where the picture of a stroke from brightness has another size.
void CheckPicture(const DepthStroke& stroke, const MendedScene& scene, const DepthMap& relief);

}  // namespace arthro::authoring
