// Queries of the volume removed by edits, used to cut meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "simulation/tissue/field/grid_cell.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

double SolidField::CutDistance(const glm::dvec3& x) const noexcept {
  if (cut_.empty()) return -band();
  const CellPlace place = Locate(grid_, x);
  return Interpolate(CornersAt(cut_, grid_, place.index), place.part);
}

void SolidField::CutDistances(std::span<const glm::dvec3> x, std::span<double> distance,
                              std::span<NodeNear> node) const noexcept {
  for (std::size_t i = 0; i < x.size(); ++i) {
    distance[i] = -band();
    node[i] = {};
    if (cut_.empty()) continue;
    const CellPlace place = Locate(grid_, x[i]);
    const Corners corners = CornersAt(cut_, grid_, place.index);
    distance[i] = Interpolate(corners, place.part);
    if (distance[i] > 0.0) continue;
    const std::size_t row = static_cast<std::size_t>(grid_.count[0]);
    const std::size_t layer = row * static_cast<std::size_t>(grid_.count[1]);
    const auto index = [&](std::size_t c) {
      return static_cast<std::int32_t>(place.index + (c & 1) + (c >> 1 & 1) * row +
                                       (c >> 2) * layer);
    };
    for (const double value : corners.value) node[i].is_cell_whole &= value <= 0.0;
    const glm::dvec3& t = place.part;
    if (node[i].is_cell_whole) {
      node[i].index = index((t.x > 0.5 ? 1u : 0u) + (t.y > 0.5 ? 2u : 0u) + (t.z > 0.5 ? 4u : 0u));
      continue;
    }
    // An interpolated value ≤ 0 has a corner value ≤ 0.
    double largest = -1.0;
    for (std::size_t c = 0; c < 8; ++c) {
      const double weight = ((c & 1) != 0 ? t.x : 1 - t.x) * ((c & 2) != 0 ? t.y : 1 - t.y) *
                            ((c & 4) != 0 ? t.z : 1 - t.z);
      if (corners.value[c] > 0.0 || weight <= largest) continue;
      largest = weight;
      node[i].index = index(c);
    }
  }
}

bool SolidField::AreJoined(const NodeNear& a, const NodeNear& b) const noexcept {
  // Cells of points at most one spacing apart share a corner.
  if (a.index == b.index || (a.is_cell_whole && b.is_cell_whole)) return true;
  if (a.index < 0 || b.index < 0) return false;
  const auto at = [&](std::int32_t node) {
    const int nx = grid_.count[0], ny = grid_.count[1];
    return std::array<int, 3>{node % nx, node / nx % ny, node / nx / ny};
  };
  const std::array<int, 3> from = at(a.index), to = at(b.index);
  std::array<int, 3> low, size;
  int beside = 0;  // grid steps between the nodes
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(from[i], to[i]);
    size[i] = std::abs(from[i] - to[i]) + 1;
    beside += size[i] - 1;
  }
  if (beside == 1) return true;
  if (size[0] * size[1] * size[2] > 64) return false;  // further apart than neighbours can be
  // Flood fill from a, with one bit per node of the box.
  const auto bit = [&](int i, int j, int k) {
    return std::uint64_t{1} << ((k * size[1] + j) * size[0] + i);
  };
  std::uint64_t solid = 0;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        if (cut_[grid_.Index(low[0] + i, low[1] + j, low[2] + k)] <= 0.0f) solid |= bit(i, j, k);
  const std::uint64_t goal = bit(to[0] - low[0], to[1] - low[1], to[2] - low[2]);
  std::uint64_t reached = bit(from[0] - low[0], from[1] - low[1], from[2] - low[2]), last = 0;
  while (reached != last && (reached & goal) == 0) {
    last = reached;
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) {
          if ((solid & bit(i, j, k)) == 0) continue;
          const bool is_beside = (i > 0 && (reached & bit(i - 1, j, k)) != 0) ||
                                 (i + 1 < size[0] && (reached & bit(i + 1, j, k)) != 0) ||
                                 (j > 0 && (reached & bit(i, j - 1, k)) != 0) ||
                                 (j + 1 < size[1] && (reached & bit(i, j + 1, k)) != 0) ||
                                 (k > 0 && (reached & bit(i, j, k - 1)) != 0) ||
                                 (k + 1 < size[2] && (reached & bit(i, j, k + 1)) != 0);
          if (is_beside) reached |= bit(i, j, k);
        }
  }
  return (reached & goal) != 0;
}

bool SolidField::MayBeCut(const Box3& box) const noexcept {
  if (cut_.empty() || box.empty()) return false;
  // Covers all nodes of all cells that the box meets, clamped to the grid as in queries.
  std::array<int, 3> first, last;
  for (int a = 0; a < 3; ++a) {
    const double end = grid_.count[static_cast<std::size_t>(a)] - 1;
    const auto node = [&](double x) { return std::min(std::max(0.0, x), end); };
    const double low = (box.low[a] - grid_.origin[a]) / grid_.spacing;
    const double high = (box.high[a] - grid_.origin[a]) / grid_.spacing;
    first[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(node(low)));
    last[static_cast<std::size_t>(a)] = static_cast<int>(std::ceil(node(high)));
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        if (cut_[grid_.Index(i, j, k)] > 0.0f) return true;
  return false;
}

}  // namespace arthro::simulation
