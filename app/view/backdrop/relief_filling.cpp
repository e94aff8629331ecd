#include "app/view/backdrop/relief_filling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace arthro::app {
namespace {

// Means of the known values of 2 x 2 texels; NaN where there is none.
DepthMap Halved(const DepthMap& relief) {
  DepthMap half((relief.width + 1) / 2, (relief.height + 1) / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      float sum = 0;
      int known = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, relief.height); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, relief.width); ++u)
          if (std::isfinite(relief.at(u, v))) sum += relief.at(u, v), ++known;
      half.at(x, y) =
          known > 0 ? sum / static_cast<float>(known) : std::numeric_limits<float>::quiet_NaN();
    }
  return half;
}

// Value of the coarser map at the middle of a finer texel.
float Between(const DepthMap& coarse, int x, int y) {
  const float u = std::clamp(0.5f * static_cast<float>(x) - 0.25f, 0.0f,
                             static_cast<float>(coarse.width - 1)),
              v = std::clamp(0.5f * static_cast<float>(y) - 0.25f, 0.0f,
                             static_cast<float>(coarse.height - 1));
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int right = std::min(i + 1, coarse.width - 1), below = std::min(j + 1, coarse.height - 1);
  const float f = u - static_cast<float>(i), g = v - static_cast<float>(j);
  return (1 - g) * ((1 - f) * coarse.at(i, j) + f * coarse.at(right, j)) +
         g * ((1 - f) * coarse.at(i, below) + f * coarse.at(right, below));
}

}  // namespace

void FillUnknown(DepthMap& relief) {
  if (std::all_of(relief.relief.begin(), relief.relief.end(),
                  [](float h) { return std::isfinite(h); }))
    return;
  if (relief.width <= 1 && relief.height <= 1) {
    std::fill(relief.relief.begin(), relief.relief.end(), 0.0f);
    return;
  }
  DepthMap coarse = Halved(relief);
  FillUnknown(coarse);
  for (int y = 0; y < relief.height; ++y)
    for (int x = 0; x < relief.width; ++x)
      if (!std::isfinite(relief.at(x, y))) relief.at(x, y) = Between(coarse, x, y);
}

}  // namespace arthro::app
