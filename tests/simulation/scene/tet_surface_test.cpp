// Outer surface of tetrahedra.
#include "simulation/scene/mesh/tet_surface.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro {
namespace {

double Volume(const SurfaceMesh& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += glm::dot(surface.vertices[static_cast<std::size_t>(a)],
                    glm::cross(surface.vertices[static_cast<std::size_t>(b)],
                               surface.vertices[static_cast<std::size_t>(c)])) /
           6;
  return sum;
}

TEST(TetSurface, LeavesOutTheFaceBetweenTwoElementsAndFacesOutwards) {
  TetMesh mesh;
  // Node 2 is in no element.
  mesh.rest_positions = {{0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.elements = {0, 1, 3, 4, 0, 3, 1, 5};
  const SurfaceMesh surface = SurfaceOf(mesh);
  EXPECT_EQ(surface.vertices.size(), 5u);
  EXPECT_EQ(surface.triangles.size(), 6u);
  EXPECT_NEAR(Volume(surface), 2.0 / 6, 1e-12);
}

TEST(TetSurface, TakesTheMiddlesOfCurvedFaces) {
  TetMesh mesh;
  mesh.order = 2;
  const glm::dvec3 x[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& corner : x) mesh.rest_positions.push_back(corner);
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  for (const auto& [a, b] : kEdges) mesh.rest_positions.push_back(0.5 * (x[a] + x[b]));
  mesh.elements = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const SurfaceMesh surface = SurfaceOf(mesh);
  EXPECT_EQ(surface.vertices.size(), 10u);
  EXPECT_EQ(surface.triangles.size(), 16u);
  // Each middle with its own corners: else the volume would not be that of the element.
  EXPECT_NEAR(Volume(surface), 1.0 / 6, 1e-12);
}

}  // namespace
}  // namespace arthro
