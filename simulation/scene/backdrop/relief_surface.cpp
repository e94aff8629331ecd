#include "simulation/scene/backdrop/relief_surface.h"

#include <algorithm>
#include <cmath>

namespace arthro {
namespace {

// Largest depth within `reach` pixels; NaN where nothing was imaged at the pixel itself.
float HighestAround(const DepthMap& depth, int u, int v, int reach) {
  float highest = depth.at(u, v);
  if (!std::isfinite(highest)) return highest;
  for (int y = std::max(0, v - reach); y <= std::min(depth.height - 1, v + reach); ++y)
    for (int x = std::max(0, u - reach); x <= std::min(depth.width - 1, u + reach); ++x)
      if (depth.at(x, y) > highest) highest = depth.at(x, y);
  return highest;
}

}  // namespace

ReliefSurface MakeReliefSurface(int width, int height, const DepthMap& depth,
                                const Backdrop& backdrop, int cells, ReliefSample sample) {
  ReliefSurface surface;
  if (width < 2 || height < 2) return surface;
  const int step = std::max(1, std::max(width, height) / cells);
  const int columns = (width - 1) / step + 1, rows = (height - 1) / step + 1;
  const int reach = sample == ReliefSample::kHighest ? step : 0;
  std::vector<char> is_imaged;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      // The last row and column lie on the picture's edge.
      const int u = i + 1 < columns ? i * step : width - 1;
      const int v = j + 1 < rows ? j * step : height - 1;
      const float h = depth.empty() ? 0.0f : HighestAround(depth, u, v, reach);
      is_imaged.push_back(std::isfinite(h) ? 1 : 0);
      surface.pixel.emplace_back(u, v);
      surface.mesh.vertices.push_back(
          (backdrop.radius - (std::isfinite(h) ? static_cast<double>(h) : 0.0)) *
          DirectionFromPixel(backdrop.projection, surface.pixel.back()));
    }
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      const auto imaged = [&](int k) { return is_imaged[static_cast<std::size_t>(k)] != 0; };
      if (!imaged(a) || !imaged(b) || !imaged(c) || !imaged(d)) continue;
      // x right, y down: a-b-c-d runs clockwise seen from the portal.
      surface.mesh.triangles.push_back({a, d, c});
      surface.mesh.triangles.push_back({a, c, b});
    }
  return surface;
}

}  // namespace arthro
