#include "simulation/scene/mesh/vertex_normals.h"

#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace arthro {
namespace {

TEST(VertexNormals, OfASphereAreItsRadii) {
  const SurfaceMesh mesh = test::Sphere(glm::dvec3(0.0), 0.01, 4);
  std::vector<glm::dvec3> normals(mesh.vertices.size());
  ComputeVertexNormals(mesh.vertices, mesh.triangles, normals);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_GT(glm::dot(normals[i], glm::normalize(mesh.vertices[i])), 0.999);
}

TEST(VertexNormals, AVertexWithoutTrianglesHasOneAllTheSame) {
  const SurfaceMesh mesh = test::Sphere(glm::dvec3(0.0), 0.01, 1);
  std::vector<glm::dvec3> normals(mesh.vertices.size(), glm::dvec3(1, 2, 3));
  ComputeVertexNormals(mesh.vertices, {}, normals);
  for (const glm::dvec3& normal : normals) EXPECT_EQ(normal, glm::dvec3(0, 0, 1));
}

}  // namespace
}  // namespace arthro
