#include "authoring/depth/steps/step_width.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <future>
#include <numbers>
#include <vector>

namespace arthro::authoring {
namespace {

// Highest relief below `depth` that is nowhere steeper, in two passes [Borgefors 1986]. With `sign`
// −1 the lowest above it, negated.
std::vector<float> Envelope(const DepthMap& depth, double steepest, float sign) {
  const int width = depth.width, height = depth.height;
  const auto straight = static_cast<float>(steepest);
  const auto slanted = static_cast<float>(std::numbers::sqrt2 * steepest);
  std::vector<float> value(depth.relief.size());
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = sign * depth.relief[i];
  const auto pass = [&](int first, int step) {
    const int left = step > 0 ? 0 : width - 1;
    for (int row = 0, y = first; row < height; ++row, y += step) {
      float* line = value.data() + static_cast<std::ptrdiff_t>(y) * width;
      const float* before = row > 0 ? line - static_cast<std::ptrdiff_t>(step) * width : nullptr;
      for (int column = 0, x = left; column < width; ++column, x += step) {
        float own = line[x];
        if (std::isnan(own)) continue;
        // A comparison with an unknown neighbour is false.
        const auto reach = [&own](float neighbour, float change) {
          if (neighbour + change < own) own = neighbour + change;
        };
        if (column > 0) reach(line[x - step], straight);
        if (before != nullptr) {
          reach(before[x], straight);
          if (x > 0) reach(before[x - 1], slanted);
          if (x + 1 < width) reach(before[x + 1], slanted);
        }
        line[x] = own;
      }
    }
  };
  pass(0, 1);
  pass(height - 1, -1);
  return value;
}

}  // namespace

void LimitSteepness(DepthMap& depth, double steepest) {
  if (!(steepest > 0.0) || depth.empty()) return;
  auto other = std::async(std::launch::async, [&] { return Envelope(depth, steepest, -1.0f); });
  const std::vector<float> below = Envelope(depth, steepest, 1.0f);
  const std::vector<float> above = other.get();
  for (std::size_t i = 0; i < below.size(); ++i)
    if (below[i] != -above[i]) depth.relief[i] = 0.5f * (below[i] - above[i]);
}

}  // namespace arthro::authoring
