#include "simulation/tissue/field/pieces.h"

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/tissue/field/polygonise.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

// Bar of 12 × 4 × 4 mm.
SolidField Bar() {
  return SolidField::FromSurface(test::Box(glm::dvec3(0), glm::dvec3(12, 4, 4) * kMm), 0.3 * kMm);
}
void CutAcross(SolidField& bar, double x) {
  bar.Subtract(bar.box(), [=](const glm::dvec3& p) { return std::abs(p.x - x) - 0.25 * kMm; });
}
double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Counts the connected surfaces of the skin.
int SurfacesOf(const SurfaceMesh& surface) {
  std::vector<int> root(surface.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[static_cast<std::size_t>(v)] != v) v = root[static_cast<std::size_t>(v)];
    return v;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    root[static_cast<std::size_t>(find(a))] = find(b);
    root[static_cast<std::size_t>(find(b))] = find(c);
  }
  int count = 0;
  for (std::size_t v = 0; v < root.size(); ++v) count += root[v] == static_cast<int>(v);
  return count;
}

TEST(Pieces, PieceVolumesSumToTheFieldVolume) {
  SolidField bar = Bar();
  EXPECT_EQ(PiecesOf(bar).count(), 1);
  EXPECT_NEAR(PiecesOf(bar).volume[0], bar.Volume(), 1e-12 * bar.Volume());
  CutAcross(bar, 3.1 * kMm);
  CutAcross(bar, 7.7 * kMm);
  const FieldPieces pieces = PiecesOf(bar);
  ASSERT_EQ(pieces.count(), 3);
  EXPECT_NEAR(Sum(pieces.volume), bar.Volume(), 1e-12 * bar.Volume());
  const std::array<double, 3> lengths{3.1 - 0.25, 7.7 - 3.1 - 0.5, 12 - 7.7 - 0.25};
  for (std::size_t i = 0; i < 3; ++i)  // edges are rounded by at most 0.25 h² per length
    EXPECT_NEAR(pieces.volume[i], lengths[i] * 16 * kMm3, 0.03 * lengths[i] * 16 * kMm3);
  EXPECT_EQ(SurfacesOf(Polygonise(bar)), 3) << "the skin has as many parts as the solid";
}

TEST(Pieces, PiecesWithoutAnchorAreLoose) {
  SolidField bar = Bar();
  CutAcross(bar, 3.1 * kMm);
  CutAcross(bar, 7.7 * kMm);
  const FieldPieces pieces = PiecesOf(bar);
  const std::vector<Ball> anchors{{glm::dvec3(0, 2, 2) * kMm, 1 * kMm},
                                  {glm::dvec3(12, 2, 2) * kMm, 1 * kMm},
                                  {glm::dvec3(40, 2, 2) * kMm, 1 * kMm}};
  EXPECT_EQ(HeldPieces(bar, pieces, anchors), (std::vector<unsigned char>{1, 0, 1}));
  EXPECT_EQ(HeldPieces(bar, pieces, {}), (std::vector<unsigned char>{0, 0, 0}));
}

TEST(Pieces, CrumbsAreRemovedByVolumeAndCounted) {
  SolidField bar = Bar();
  CutAcross(bar, 0.9 * kMm);
  CutAcross(bar, 6 * kMm);
  const FieldPieces before = PiecesOf(bar);
  ASSERT_EQ(before.count(), 3);
  const double whole = bar.Volume();
  const CrumbReport report = RemoveCrumbs(bar, 20 * kMm3);
  EXPECT_EQ(report.crumbs, 1);
  // A slot of at least one spacing has no cell with corners on both sides, so exactly its volume is
  // removed.
  EXPECT_NEAR(report.edit.removed, before.volume[0], 1e-12 * whole);
  EXPECT_NEAR(report.edit.removed + bar.Volume(), whole, 1e-12 * whole);
  EXPECT_EQ(PiecesOf(bar).count(), 2);
  EXPECT_EQ(RemoveCrumbs(bar, 20 * kMm3).crumbs, 0);
}

// Compares with a flood fill from node to node, on a foam of drops that touch along edges, at
// corners or not at all.
TEST(Pieces, ConnectivityFollowsGridEdgesAndSingleVolumesAgree) {
  const SolidField foam = SolidField::FromFunction(
      {glm::dvec3(0), glm::dvec3(5 * kMm)}, 0.2 * kMm, [](const glm::dvec3& x) {
        const glm::dvec3 at = x / kMm;
        return kMm * (std::sin(7.1 * at.x + 2 * at.y) * std::sin(5.3 * at.y) *
                          std::sin(6.1 * at.z + at.x) +
                      0.25);
      });
  const FieldPieces pieces = PiecesOf(foam);
  ASSERT_GT(pieces.count(), 20);
  const FieldGrid& grid = foam.grid();
  std::vector<int> flooded(grid.NodeCount(), -1);
  int count = 0;
  for (std::size_t start = 0; start < flooded.size(); ++start) {
    if (!(foam.values()[start] < 0) || flooded[start] >= 0) continue;
    std::vector<std::size_t> front{start};
    flooded[start] = count;
    while (!front.empty()) {
      const std::size_t node = front.back();
      front.pop_back();
      for (const std::size_t step : {grid.Index(1, 0, 0), grid.Index(0, 1, 0), grid.Index(0, 0, 1)})
        for (const std::size_t other : {node - step, node + step})
          if (foam.values()[other] < 0 && flooded[other] < 0) {
            flooded[other] = count;
            front.push_back(other);
          }
    }
    ++count;
  }
  EXPECT_EQ(pieces.count(), count);
  EXPECT_EQ(pieces.piece, flooded);
  EXPECT_NEAR(Sum(pieces.volume), foam.Volume(), 1e-12 * foam.Volume());
  const FieldPieces unmeasured = PiecesWithoutVolumes(foam);
  EXPECT_EQ(unmeasured.piece, pieces.piece);
  for (int i = 0; i < count; ++i)
    EXPECT_EQ(VolumeOfPiece(foam, unmeasured, i), pieces.volume[static_cast<std::size_t>(i)]);
}

TEST(Pieces, EmptyFieldHasNoPieces) {
  SolidField none;
  EXPECT_EQ(PiecesOf(none).count(), 0);
  EXPECT_EQ(RemoveCrumbs(none, 1.0).crumbs, 0);
}

}  // namespace
}  // namespace arthro::simulation
