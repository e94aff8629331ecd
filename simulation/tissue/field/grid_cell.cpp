#include "simulation/tissue/field/grid_cell.h"

#include <cmath>
#include <cstddef>

namespace arthro::simulation {

double SolidPart(const std::array<double, 8>& corner) noexcept {
  int solid = 0;
  for (const double value : corner) solid += value < 0.0;
  if (solid == 0) return 0.0;
  if (solid == 8) return 1.0;
  // Picks the axis of the largest change, because lines along it cross the surface most squarely.
  std::size_t axis = 0;
  double steepest = -1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    double change = 0.0;
    for (std::size_t c = 0; c < 8; ++c) change += (c >> a & 1) ? corner[c] : -corner[c];
    if (std::abs(change) > steepest) steepest = std::abs(change), axis = a;
  }
  const std::size_t step = std::size_t{1} << axis, u = std::size_t{1} << (axis + 1) % 3,
                    v = std::size_t{1} << (axis + 2) % 3;
  constexpr int kLines = 4;
  double sum = 0.0;
  for (int i = 0; i < kLines; ++i)
    for (int j = 0; j < kLines; ++j) {
      const double s = (i + 0.5) / kLines, t = (j + 0.5) / kLines;
      const auto at = [&](std::size_t end) {
        return (1 - s) * ((1 - t) * corner[end] + t * corner[end + v]) +
               s * ((1 - t) * corner[end + u] + t * corner[end + u + v]);
      };
      const double low = at(0), high = at(step);
      if (low < 0.0)
        sum += high < 0.0 ? 1.0 : low / (low - high);
      else if (high < 0.0)
        sum += high / (high - low);
    }
  return sum / (kLines * kLines);
}

}  // namespace arthro::simulation
