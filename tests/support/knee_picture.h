// A picture like an arthroscopic panorama, made in code: a round imaged area on black, smooth
// tissue lit by how near it is, noise and glints. The same every time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulation/scene/image.h"

namespace arthro::test {

// The relief, 0 to 1, that the picture below is lit by; waves of different lengths.
inline double KneeRelief(double u, double v) {
  return std::clamp(0.5 + 0.25 * std::sin(5.1 * u + 0.4) * std::cos(4.3 * v) +
                        0.15 * std::sin(11.0 * u - 7.0 * v) + 0.08 * std::cos(23.0 * v + 9.0 * u),
                    0.0, 1.0);
}

inline ColourImage KneePicture(int width, int height, double noise = 6.0, bool glints = true) {
  ColourImage image(width, height);
  std::uint32_t random = 12345;
  const auto next = [&] { return ((random = random * 1664525u + 1013904223u) >> 8) / 16777216.0; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (2.0 * x + 1.0) / width - 1.0, v = (2.0 * y + 1.0) / height - 1.0;
      const double grain = noise * (next() + next() + next() - 1.5);
      if (u * u + v * v > 0.96) continue;
      const double light = 40.0 + 180.0 * KneeRelief(u, v) + grain;
      const double glint = std::sin(37.0 * u + 3.0) * std::sin(41.0 * v);
      const bool is_glint = glints && glint > 0.985;
      std::uint8_t* p = image.at(x, y);
      for (int c = 0; c < 3; ++c)
        p[c] = static_cast<std::uint8_t>(is_glint ? 255.0
                                                  : std::clamp(light * (c == 0   ? 1.1
                                                                        : c == 1 ? 0.95
                                                                                 : 0.85),
                                                               0.0, 245.0));
    }
  return image;
}

}  // namespace arthro::test
