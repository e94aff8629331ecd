#include "authoring/tissue/tetrahedra/tet_improve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/tissue/surface/surface_check.h"
#include "authoring/tissue/surface/surface_simplify.h"
#include "authoring/tissue/tetrahedra/tet_quality.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

constexpr double kDegree = M_PI / 180;

// Boundary faces, facing outwards.
SurfaceMesh BoundaryOf(const TetMesh& mesh) {
  constexpr std::array<std::array<int, 3>, 4> kFaces = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const int nodes = mesh.order == 2 ? 10 : 4;
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> faces;
  for (int e = 0; e < mesh.ElementCount(); ++e)
    for (const auto& face : kFaces) {
      std::array<int, 3> corners{};
      for (int k = 0; k < 3; ++k)
        corners[k] = mesh.elements[static_cast<std::size_t>(e) * nodes + face[k]];
      std::array<int, 3> key = corners;
      std::sort(key.begin(), key.end());
      auto& entry = faces[key];
      ++entry.first;
      entry.second = corners;
    }
  SurfaceMesh surface;
  surface.vertices = mesh.rest_positions;
  for (const auto& [key, entry] : faces)
    if (entry.first == 1) surface.triangles.push_back(entry.second);
  return surface;
}

TetMesh CoarseTorus(const SurfaceMesh& fine) {
  SurfaceMesh coarse = fine;
  SimplifyEvenly(coarse, 220, [](const glm::dvec3&) { return 1.0; });
  TetrahedralizeOptions options;
  options.order = 2;
  options.keep_surface = true;
  options.min_dihedral = 0;
  return Tetrahedralize(coarse, {}, options, nullptr, {}, ARTHRO_PROGRAM);
}

TEST(TetImprove, RaisesTheSmallestAngleAndKeepsASoundMesh) {
  const SurfaceMesh fine = test::Torus(0.015, 0.004, 60, 24);
  TetMesh mesh = CoarseTorus(fine);
  const TetQuality before = MeasureTets(mesh);
  const TetImprovement report = ImproveTets(mesh, fine, 12 * kDegree);
  const TetQuality after = MeasureTets(mesh);
  std::printf("%.2f to %.2f degrees; volume %.2f %% of before\n", before.min_dihedral / kDegree,
              after.min_dihedral / kDegree, 100 * after.volume / before.volume);
  EXPECT_NEAR(report.before, before.min_dihedral, 1e-9);  // the same angle by another formula
  EXPECT_NEAR(report.after, after.min_dihedral, 1e-9);
  EXPECT_LT(before.min_dihedral, 10 * kDegree) << "the mesh was good before";
  EXPECT_GE(after.min_dihedral, 10 * kDegree);
  EXPECT_EQ(after.inverted, 0);
  EXPECT_EQ(mesh.order, 2);
  // The boundary stays one closed ring that encloses the elements.
  SurfaceMesh boundary = BoundaryOf(mesh);
  const SurfaceCheck check = CheckSurface(boundary);
  EXPECT_TRUE(check.IsClosedManifold());
  EXPECT_EQ(check.components, 1);
  EXPECT_EQ(check.self_intersections.count, 0);
  EXPECT_NEAR(check.volume, after.volume, 1e-9 * after.volume);
  // The simplification was allowed to be this far off; 3 % is the bound of the budget's test.
  EXPECT_NEAR(after.volume, before.volume, 0.03 * before.volume);
}

TEST(TetImprove, LeavesAGoodMeshAlone) {
  TetMesh mesh;
  mesh.rest_positions = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
  mesh.elements = {0, 1, 2, 3};
  const TetMesh before = mesh;
  SurfaceMesh surface = BoundaryOf(mesh);
  const TetImprovement report = ImproveTets(mesh, surface, 30 * kDegree);
  EXPECT_EQ(mesh.rest_positions, before.rest_positions);
  EXPECT_EQ(mesh.elements, before.elements);
  EXPECT_EQ(report.edges_removed + report.faces_flipped + report.edges_collapsed, 0);
  EXPECT_EQ(report.nodes_moved, 0);
}

// Four nodes near a plane between two apexes: the flat element goes, the volume stays.
TEST(TetImprove, RemovesAnElementThatIsNearlyFlat) {
  TetMesh mesh;
  const double h = 1e-5;
  mesh.rest_positions = {{0.01, 0, h},   {0, 0.01, -h}, {-0.01, 0, h},
                         {0, -0.01, -h}, {0, 0, 0.01},  {0, 0, -0.01}};
  // The flat one, two above its upper faces, two below its lower ones.
  for (const std::array<int, 4>& tet :
       {std::array{0, 1, 2, 3}, std::array{0, 1, 2, 4}, std::array{0, 2, 3, 4},
        std::array{0, 1, 3, 5}, std::array{1, 2, 3, 5}}) {
    const auto& x = mesh.rest_positions;
    std::array<int, 4> turned = tet;
    if (glm::dot(glm::cross(x[tet[1]] - x[tet[0]], x[tet[2]] - x[tet[0]]), x[tet[3]] - x[tet[0]]) <
        0)
      std::swap(turned[0], turned[1]);
    mesh.elements.insert(mesh.elements.end(), turned.begin(), turned.end());
  }
  const TetQuality before = MeasureTets(mesh);
  ASSERT_LT(before.min_dihedral, 1 * kDegree);
  const SurfaceMesh surface = BoundaryOf(mesh);
  ImproveTets(mesh, surface, 20 * kDegree);
  const TetQuality after = MeasureTets(mesh);
  EXPECT_GT(after.min_dihedral, 20 * kDegree);
  EXPECT_NEAR(after.volume, before.volume, 1e-3 * before.volume);
}

TEST(TetImprove, SameInputGivesTheSameMesh) {
  const SurfaceMesh fine = test::Torus(0.015, 0.004, 60, 24);
  TetMesh a = CoarseTorus(fine), b = CoarseTorus(fine);
  ImproveTets(a, fine, 12 * kDegree);
  ImproveTets(b, fine, 12 * kDegree);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.rest_positions, b.rest_positions);
}

}  // namespace
}  // namespace arthro::authoring
