// A lens without distortion behind a round window, for tests of pictures and files.
#pragma once

#include "simulation/scene/lens.h"

namespace arthro::test {

// A lens for pictures of `width` x `height` px; principal point and centre of the round window are
// the same. Its field of view is left as it is by default.
inline Lens RoundLens(int width, int height, double focal_px, double cx, double cy,
                      double radius_px) {
  Lens lens;
  lens.width = width;
  lens.height = height;
  lens.focal_px = focal_px;
  lens.cx = cx;
  lens.cy = cy;
  lens.circle = {cx, cy, radius_px};
  return lens;
}

}  // namespace arthro::test
