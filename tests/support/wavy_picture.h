// A small colour picture with some structure, the same every time.
#pragma once

#include <cmath>
#include <cstdint>

#include "simulation/scene/image.h"

namespace arthro::test {

inline ColourImage WavyPicture(int width, int height) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<std::uint8_t>(128 + 100 * std::sin(0.1 * x + 0.07 * y + c));
  return image;
}

}  // namespace arthro::test
