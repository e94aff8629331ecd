// Tetrahedron divided evenly into n³ parts of equal volume: the sample points of a field in an
// element, and their connectivity. Points have integer barycentric coordinates that sum to n. On a
// common face the points coincide with the neighbour's, also if that has half or twice the
// resolution.
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
  std::vector<std::array<std::int16_t, 4>> part;  // corners, as point indices
  // Regions of each part: bit c stands for the region nearest to corner c. A part with several bits
  // is divided evenly.
  std::vector<std::uint8_t> region;
  std::array<double, 4> region_total{};
  // Parts around one corner of a cubic arrangement are consecutive. If all points of a cell are
  // alike, its parts are counted at once.
  struct Cell {
    std::int32_t first = 0, last = 0;      // parts
    std::array<std::int16_t, 8> corner{};  // all their points; some repeat
    std::array<double, 4> region{};        // sums over their regions
  };
  std::vector<Cell> cell;
  std::vector<std::int32_t> neighbour_begin;  // per point, index into `neighbour`
  std::vector<std::int16_t> neighbour;        // points that share a part with it

  int PointAt(int l1, int l2, int l3) const {  // l0 is the rest of n
    const auto m = static_cast<std::size_t>(n) + 1;
    return index_[(static_cast<std::size_t>(l3) * m + static_cast<std::size_t>(l2)) * m +
                  static_cast<std::size_t>(l1)];
  }
  glm::dvec4 BarycentricOf(int i) const {
    const auto& l = point[static_cast<std::size_t>(i)];
    return glm::dvec4(l[0], l[1], l[2], l[3]) / static_cast<double>(n);
  }
  // Returns the point nearest to these barycentric coordinates; coordinates outside are clamped.
  int Nearest(const glm::dvec4& barycentric) const;

  std::vector<std::int16_t> index_;  // index of each point, for PointAt
};

// Adds `part` to the regions of a part, evenly.
inline void AddToRegions(std::uint8_t region, double part, std::array<double, 4>& sum) {
  if (std::has_single_bit(region)) {
    sum[static_cast<std::size_t>(std::countr_zero(region))] += part;
    return;
  }
  for (std::size_t c = 0; c < 4; ++c)
    if ((region >> c & 1) != 0) sum[c] += part / std::popcount(region);
}

TetLattice MakeTetLattice(int n);

// Returns the fraction of a tetrahedron in which the linear interpolation of its corner values is
// negative; a zero counts as negative.
double NegativePart(const std::array<double, 4>& value) noexcept;

}  // namespace arthro::simulation
