#include "simulation/scene/pixel_bounds.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace arthro {

PixelBounds DifferenceOf(const DepthMap& before, const DepthMap& after) {
  PixelBounds box;
  if (before.width != after.width || before.height != after.height)
    return {0, 0, after.width, after.height};
  const auto width = static_cast<std::size_t>(after.width);
  for (int y = 0; y < after.height; ++y) {
    const float* a = &before.relief[static_cast<std::size_t>(y) * width];
    const float* b = &after.relief[static_cast<std::size_t>(y) * width];
    if (std::memcmp(a, b, width * sizeof(float)) == 0) continue;
    const auto differs = [&](int x) {
      return std::bit_cast<std::uint32_t>(a[x]) != std::bit_cast<std::uint32_t>(b[x]);
    };
    int left = 0, right = after.width;
    while (!differs(left)) ++left;
    while (!differs(right - 1)) --right;
    box = Joined(box, {left, y, right, y + 1});
  }
  return box;
}

}  // namespace arthro
