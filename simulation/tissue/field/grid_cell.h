// One cell of a field's grid: the position of a point in it, and the trilinear interpolation of its
// corner values. Corners run x fastest, z slowest.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <glm/vec3.hpp>

#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Position of x in the grid: cell and fraction within the cell, for x clamped to the grid.
struct CellPlace {
  std::size_t index;
  glm::dvec3 part, clamped;
};

inline CellPlace Locate(const FieldGrid& grid, const glm::dvec3& x) noexcept {
  CellPlace place;
  std::array<int, 3> cell;
  const double per_spacing = 1.0 / grid.spacing;
  for (int a = 0; a < 3; ++a) {
    const int last = grid.count[static_cast<std::size_t>(a)] - 1;
    // This order of min and max turns NaN into 0.
    const double t =
        std::min(std::max(0.0, (x[a] - grid.origin[a]) * per_spacing), static_cast<double>(last));
    const int i = std::min(static_cast<int>(t), last - 1);
    cell[static_cast<std::size_t>(a)] = i;
    place.part[a] = t - i;
    place.clamped[a] = grid.origin[a] + t * grid.spacing;
  }
  place.index = grid.Index(cell[0], cell[1], cell[2]);
  return place;
}

struct Corners {
  std::array<double, 8> value;
};

inline Corners CornersAt(std::span<const float> values, const FieldGrid& grid,
                         std::size_t index) noexcept {
  const std::size_t row = static_cast<std::size_t>(grid.count[0]);
  const std::size_t layer = row * static_cast<std::size_t>(grid.count[1]);
  return {{values[index], values[index + 1], values[index + row], values[index + row + 1],
           values[index + layer], values[index + layer + 1], values[index + layer + row],
           values[index + layer + row + 1]}};
}

inline double Interpolate(const Corners& corners, const glm::dvec3& t) noexcept {
  const auto& c = corners.value;
  const double x00 = c[0] + t.x * (c[1] - c[0]), x10 = c[2] + t.x * (c[3] - c[2]);
  const double x01 = c[4] + t.x * (c[5] - c[4]), x11 = c[6] + t.x * (c[7] - c[6]);
  const double y0 = x00 + t.y * (x10 - x00), y1 = x01 + t.y * (x11 - x01);
  return y0 + t.z * (y1 - y0);
}

// Returns the solid fraction of a cell, 0 to 1: the part of the unit cube in which the trilinear
// interpolation of the corner values is negative; corner values run x fastest, z slowest. Sums 4 ×
// 4 lines along the axis of the steepest change, each of which is exact. The error is about 1e-3 of
// a cell that the surface passes through, of either sign.
double SolidPart(const std::array<double, 8>& corner) noexcept;

}  // namespace arthro::simulation
