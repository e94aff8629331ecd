// A stroke that grows while it is drawn. Each new point changes only the tiles that its piece of
// the line reaches, and the map has the bytes that the whole stroke gives at once. Exceptions:
// flatten and brightness fit one plane or mean to all of their tiles, which change with it, and a
// mask is closed as a whole.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "authoring/depth/strokes/stroke_effect.h"

namespace arthro::authoring {

class GrowingStroke {
 public:
  // `stroke`: its points are those that are added. `panorama` may be null where it is not needed.
  GrowingStroke(DepthStroke stroke, std::shared_ptr<const ColourImage> panorama,
                const Projection& projection, double radius, MendedDepth before);

  // Adds points, in shares of the panorama's width. Reports the tiles that were computed, and the
  // box of what may have changed.
  StrokeReport Add(std::span<const glm::dvec2> points);

  const MendedDepth& before() const { return before_; }
  const MendedDepth& depth() const { return depth_; }  // with the stroke

 private:
  void Restore(std::span<const StrokeTile* const> tiles);

  DepthStroke stroke_;
  std::shared_ptr<const ColourImage> panorama_;
  Projection projection_;
  double radius_;
  MendedDepth before_, depth_;
  StrokeFootprint footprint_;
  std::map<StrokeFootprint::Place, StrokeSums> sums_;  // per tile; empty where none are needed
};

}  // namespace arthro::authoring
