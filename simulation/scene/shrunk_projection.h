// Projection of a reduced picture [method.md, Projection].
#pragma once

#include "simulation/scene/projection.h"

namespace arthro {

// Converts a projection to the pixels of a smaller picture, whose pixel (x, y) covers
// x·factor … x·factor + factor − 1.
inline Projection Shrunk(Projection projection, double factor) {
  projection.centre_px = (projection.centre_px - 0.5 * (factor - 1.0)) / factor;
  projection.focal_px /= factor;
  projection.px_per_deg /= factor;
  return projection;
}

}  // namespace arthro
