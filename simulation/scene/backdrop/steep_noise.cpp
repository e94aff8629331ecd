#include "simulation/scene/backdrop/steep_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

namespace arthro {
namespace {

constexpr double kLooks = 1 << 16;
constexpr std::size_t kFewest = 64;  // differences; fewer have no median worth the name
constexpr float kMedian = 0.6745f;   // distance from the mean, in standard deviations

template <class Value>
Value Median(std::vector<Value>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Distance of the pixel's right neighbour on the surface, m.
double PixelSize(const DepthMap& depth, const Backdrop& backdrop, int x, int y) {
  const Projection& projection = backdrop.projection;
  const double radius = backdrop.radius - static_cast<double>(depth.at(x, y));
  return std::abs(radius) * glm::distance(DirectionFromPixel(projection, {x, y}),
                                          DirectionFromPixel(projection, {x + 1, y}));
}

}  // namespace

std::optional<float> SteepNoise(const DepthMap& depth, const Backdrop& backdrop) {
  const double pixels = static_cast<double>(depth.width) * depth.height;
  const int stride = std::max(1, static_cast<int>(std::sqrt(pixels / kLooks)));
  std::vector<float> bends;
  std::vector<double> sizes;
  for (int y = 0; y < depth.height; y += stride)
    for (int x = 1; x + 1 < depth.width; x += stride) {
      const float bend = depth.at(x - 1, y) - 2 * depth.at(x, y) + depth.at(x + 1, y);
      if (!std::isfinite(bend)) continue;
      bends.push_back(std::abs(bend));
      sizes.push_back(PixelSize(depth, backdrop, x, y));
    }
  if (bends.size() < kFewest) return {};
  const float noise = Median(bends) / (kMedian * std::sqrt(6.0f));
  const bool is_steep = std::numbers::sqrt2 * static_cast<double>(noise) > Median(sizes);
  return is_steep ? std::optional(noise) : std::nullopt;
}

}  // namespace arthro
