#include "app/view/backdrop/rough_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/backdrop/backdrop_texture.h"
#include "app/view/backdrop/relief_filling.h"
#include "simulation/haptics/relief/relief_smoothing.h"
#include "simulation/scene/shrunk_projection.h"

namespace arthro::app {
namespace {

// Means of the known values of blocks; unknown where a block has none.
DepthMap BlockMeans(const DepthMap& map, int side) {
  DepthMap means((map.width + side - 1) / side, (map.height + side - 1) / side);
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x) {
      double sum = 0;
      int known = 0;
      for (int v = y * side; v < std::min((y + 1) * side, map.height); ++v)
        for (int u = x * side; u < std::min((x + 1) * side, map.width); ++u)
          if (const float value = map.at(u, v); std::isfinite(value)) {
            sum += static_cast<double>(value);
            ++known;
          }
      means.at(x, y) =
          known > 0 ? static_cast<float>(sum / known) : std::numeric_limits<float>::quiet_NaN();
    }
  return means;
}

// Value between the middles of pixels; beyond the outermost ones theirs.
float Between(const DepthMap& map, double x, double y) {
  x = std::clamp(x, 0.0, map.width - 1.0);
  y = std::clamp(y, 0.0, map.height - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, map.width - 1), bottom = std::min(top + 1, map.height - 1);
  const auto s = static_cast<float>(x - left), t = static_cast<float>(y - top);
  return (1 - t) * ((1 - s) * map.at(left, top) + s * map.at(right, top)) +
         t * ((1 - s) * map.at(left, bottom) + s * map.at(right, bottom));
}

}  // namespace

int BlockSide(const DepthMap& depth) {
  int side = 1;
  const auto blocks = [&](int length) { return (length + side - 1) / side; };
  while (static_cast<double>(blocks(depth.width)) * blocks(depth.height) > kMostBlocks) ++side;
  return side;
}

DepthMap RoughRelief(const DepthMap& depth, const DepthMap& sigma, const Backdrop& backdrop) {
  const int side = BlockSide(depth);
  Backdrop of_blocks = backdrop;
  of_blocks.projection = Shrunk(backdrop.projection, side);
  DepthMap blocks =
      simulation::WithoutNoise(BlockMeans(depth, side), BlockMeans(sigma, side), of_blocks);
  FillUnknown(blocks);
  DepthMap sampled = SampledRelief(depth);
  const double across = static_cast<double>(depth.width) / sampled.width / side,
               down = static_cast<double>(depth.height) / sampled.height / side;
  for (int y = 0; y < sampled.height; ++y)
    for (int x = 0; x < sampled.width; ++x)
      if (float& value = sampled.at(x, y); std::isfinite(value))
        value = Between(blocks, (x + 0.5) * across - 0.5, (y + 0.5) * down - 0.5);
  return sampled;
}

}  // namespace arthro::app
