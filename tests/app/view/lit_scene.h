// Uniformly grey backdrops, and a lens with its axis off the centre, for tests of the light.
#pragma once

#include <algorithm>
#include <cstdint>

#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/scene.h"

namespace arthro::test {

inline Backdrop PlainBackdrop(int width, int height) {
  Backdrop backdrop;
  backdrop.projection.centre_px = {(width - 1) / 2.0, (height - 1) / 2.0};
  backdrop.projection.focal_px = 0.3 * width;
  return backdrop;
}

inline ColourImage Grey(int width, int height, std::uint8_t level) {
  ColourImage image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), level);
  return image;
}

// The axis is a quarter of the window's radius off the centre.
inline Lens AsideLens() {
  Lens lens;
  lens.model = LensModel::kKannalaBrandt;
  lens.width = 720, lens.height = 576;
  lens.focal_px = 290;
  lens.cx = 360 + 65, lens.cy = 288;
  lens.k = {-0.09, 0.015, 0, 0};
  lens.circle = {360, 288, 255};
  return lens;
}

}  // namespace arthro::test
