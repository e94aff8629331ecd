// Checks that every cut mesh must pass, and a block to cut.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/tissue/cut/cut_mesh.h"
#include "tests/support/shapes.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {

// Block of 12 × 8 × 4 mm in cells of 2 mm, six elements each, and its field.
inline TetMesh CutBlock(int order) {
  return GridMesh(order,
                  {EvenTicks(0, 12 * kMm, 6), EvenTicks(0, 8 * kMm, 4), EvenTicks(0, 4 * kMm, 2)},
                  [](const glm::dvec3& p) { return p; });
}
inline simulation::SolidField CutBlockField(double spacing = 0.35 * kMm) {
  return simulation::SolidField::FromSurface(Box(glm::dvec3(0), glm::dvec3(12, 8, 4) * kMm),
                                             spacing);
}

// Checks that elements and nodes have parents, that no quadrature point is empty, no element tiny
// and no node unused, and that shares do not exceed the original.
inline void ExpectSound(const simulation::CutMesh& cut, const TetMesh& whole) {
  const std::size_t points = whole.order == 2 ? 4 : 1;
  const auto count = static_cast<std::size_t>(cut.mesh.ElementCount());
  ASSERT_EQ(cut.share.size(), count * points);
  ASSERT_EQ(cut.solid_share.size(), count * points);
  ASSERT_EQ(cut.parent_element.size(), count);
  ASSERT_EQ(cut.piece.size(), count);
  const simulation::CutOptions options;
  std::vector<int> uses(cut.mesh.rest_positions.size(), 0);
  std::vector<double> share_of_parent(static_cast<std::size_t>(whole.ElementCount()) * points, 0);
  const auto n = static_cast<std::size_t>(whole.NodesPerElement());
  for (std::size_t e = 0; e < count; ++e) {
    double mean = 0;
    for (std::size_t q = 0; q < points; ++q) {
      const double share = cut.share[e * points + q], solid = cut.solid_share[e * points + q];
      ASSERT_GE(share, options.share_floor) << "no quadrature point is empty";
      ASSERT_LE(share, 1.0);
      ASSERT_GE(solid, 0.0);
      mean += solid / static_cast<double>(points);
      share_of_parent[static_cast<std::size_t>(cut.parent_element[e]) * points + q] += solid;
    }
    ASSERT_GE(mean, 0.9 * options.min_share) << "shares of curved elements, weighted by volume";
    for (std::size_t i = 0; i < n; ++i) {
      const int node = cut.mesh.elements[e * n + i];
      ++uses[static_cast<std::size_t>(node)];
      ASSERT_EQ(cut.parent_node[static_cast<std::size_t>(node)],
                whole.elements[static_cast<std::size_t>(cut.parent_element[e]) * n + i]);
    }
  }
  for (const int use : uses) ASSERT_GT(use, 0) << "every node belongs to an element";
  for (const double share : share_of_parent) ASSERT_LE(share, 1.0 + 1e-12);
}

inline bool SameTopology(const simulation::CutMesh& a, const simulation::CutMesh& b) {
  return a.mesh.elements == b.mesh.elements && a.parent_element == b.parent_element &&
         a.parent_node == b.parent_node && a.piece == b.piece;
}

// Returns the nodes of a piece.
inline std::set<int> NodesOfPiece(const simulation::CutMesh& cut, int piece) {
  std::set<int> nodes;
  const auto n = static_cast<std::size_t>(cut.mesh.NodesPerElement());
  for (std::size_t e = 0; e < cut.piece.size(); ++e)
    if (cut.piece[e] == piece)
      nodes.insert(cut.mesh.elements.begin() + static_cast<std::ptrdiff_t>(e * n),
                   cut.mesh.elements.begin() + static_cast<std::ptrdiff_t>((e + 1) * n));
  return nodes;
}

}  // namespace arthro::test
