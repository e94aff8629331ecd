// A tetrahedron cut evenly into n³ parts of the same volume: the points at which a field is looked
// at inside an element, and what hangs together with what. Points have whole barycentric
// coordinates that sum to n. On a face the points are those of the neighbour, too, also where that
// one is cut into half or double as many.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

namespace arthro::simulation {

struct TetLattice {
  int n = 0;
  std::vector<std::array<std::uint8_t, 4>> point;
  std::vector<std::array<std::int16_t, 4>> part;  // corners, as points
  // To which of four regions a part belongs, those of what is nearest to one corner: bit c for
  // corner c. Several: it is shared evenly.
  std::vector<std::uint8_t> region;
  std::array<double, 4> region_total{};
  // Parts about one corner of a cubic arrangement lie in a row: where all their points are alike
  // they are counted at once.
  struct Cell {
    std::int32_t first = 0, last = 0;      // parts
    std::array<std::int16_t, 8> corner{};  // all their points; some more than once
    std::array<double, 4> region{};        // sums of their regions
  };
  std::vector<Cell> cell;
  std::vector<std::int32_t> neighbour_begin;  // of each point, in `neighbour`
  std::vector<std::int16_t> neighbour;        // points that share a part with it

  int PointAt(int l1, int l2, int l3) const {  // the rest of n is l0
    const auto m = static_cast<std::size_t>(n + 1);
    return index_[(static_cast<std::size_t>(l3) * m + static_cast<std::size_t>(l2)) * m +
                  static_cast<std::size_t>(l1)];
  }
  glm::dvec4 BarycentricOf(int i) const {
    const auto& l = point[static_cast<std::size_t>(i)];
    return glm::dvec4(l[0], l[1], l[2], l[3]) / static_cast<double>(n);
  }
  // The point nearest to where barycentric coordinates say; coordinates outside are clamped.
  int Nearest(const glm::dvec4& barycentric) const;

  std::vector<std::int16_t> index_;  // PointAt's
};

// Adds `part` to the regions that a part belongs to.
inline void AddToRegions(std::uint8_t region, double part, std::array<double, 4>& sum) {
  if (std::has_single_bit(region)) {
    sum[static_cast<std::size_t>(std::countr_zero(region))] += part;
    return;
  }
  for (std::size_t c = 0; c < 4; ++c)
    if ((region >> c & 1) != 0) sum[c] += part / std::popcount(region);
}

TetLattice MakeTetLattice(int n);

// What part of a tetrahedron is where the linear interpolation of its corners' values is negative;
// a zero counts as negative.
double NegativePart(const std::array<double, 4>& value) noexcept;

}  // namespace arthro::simulation
