#include "simulation/tissue/contact/embedded_skin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/random.h"
#include "tests/simulation/tissue/contact/slab.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

glm::dvec3 Any(Random& random, const glm::dvec3& low, const glm::dvec3& high) {
  return low + (high - low) *
                   glm::dvec3(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1));
}

double SumOf(const EmbeddedPoint& point) {
  double sum = 0;
  for (double w : point.weight) sum += w;
  return sum;
}

class Finder : public testing::TestWithParam<int> {
 protected:
  TetMesh Mesh() const { return GetParam() == 3 ? test::BentMesh() : test::SlabMesh(GetParam()); }
  // Maps a point of the slab to a point of the tissue.
  glm::dvec3 Place(const glm::dvec3& p) const { return GetParam() == 3 ? test::Bent(p) : p; }
};

TEST_P(Finder, WeightsReproducePointsInside) {
  const TetMesh mesh = Mesh();
  const ElementFinder finder(mesh);
  Random random(5);
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 x = Place(Any(random, test::kSlabLow, test::kSlabHigh));
    const EmbeddedPoint point = finder.Find(x);
    ASSERT_GE(point.element, 0);
    EXPECT_NEAR(SumOf(point), 1.0, 1e-12);
    largest = std::max(
        largest,
        glm::length(PlaceOf(point, finder.NodesOf(point.element), mesh.rest_positions) - x));
  }
  std::printf("inside: error of the weights at most %.1e m\n", largest);
  EXPECT_LT(largest, 1e-15) << "1e-13 of the slab";
}

TEST_P(Finder, PointsOutsideExtrapolateAndFollowAffineMotion) {
  const TetMesh mesh = Mesh();
  const ElementFinder finder(mesh);
  const glm::dmat3 a(1.1, 0.2, -0.1, 0.05, 0.9, 0.3, -0.2, 0.1, 1.2);
  std::vector<glm::dvec3> moved;
  for (const glm::dvec3& x : mesh.rest_positions) moved.push_back(a * x + glm::dvec3(0.01));
  Random random(6);
  double largest = 0;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 p = Any(random, test::kSlabLow - 1e-3, test::kSlabHigh + 1e-3);
    const glm::dvec3 x = Place(p);
    const EmbeddedPoint point = finder.Find(x);
    const glm::dvec3 there = PlaceOf(point, finder.NodesOf(point.element), moved);
    largest = std::max(largest, glm::length(there - (a * x + glm::dvec3(0.01))));
  }
  EXPECT_LT(largest, 1e-14);
}

TEST_P(Finder, FindsTheTissueAtADeformedPosition) {
  const TetMesh mesh = Mesh();
  ElementFinder finder(mesh);
  // Twist with shear: smooth, and far from the rest state.
  const auto deform = [](const glm::dvec3& x) {
    const double angle = 60.0 * x.x;
    return glm::dvec3(x.x + 0.2 * x.z, std::cos(angle) * x.y - std::sin(angle) * x.z,
                      std::sin(angle) * x.y + std::cos(angle) * x.z + 0.004);
  };
  std::vector<glm::dvec3> moved;
  for (const glm::dvec3& x : mesh.rest_positions) moved.push_back(deform(x));
  finder.Refit(moved);
  Random random(7);
  double largest = 0;
  for (int i = 0; i < 1000; ++i) {
    // The tissue's position is that of its element, not of the smooth map between nodes.
    const glm::dvec3 rest = Place(Any(random, test::kSlabLow + 1e-5, test::kSlabHigh - 1e-5));
    const EmbeddedPoint at_rest = finder.Find(rest);
    const glm::dvec3 place = PlaceOf(at_rest, finder.NodesOf(at_rest.element), moved);
    EmbeddedPoint point;
    glm::dvec3 back;
    ASSERT_TRUE(finder.FindDeformed(place, point, back)) << i;
    largest = std::max(largest, glm::length(back - rest));
  }
  std::printf("deformed: error of the rest position at most %.1e m\n", largest);
  EXPECT_LT(largest, 1e-8) << "adjacent elements agree within the tolerance of `inside`";
  EmbeddedPoint point;
  glm::dvec3 back;
  EXPECT_FALSE(finder.FindDeformed({0.1, 0, 0}, point, back));
  EXPECT_FALSE(finder.FindDeformed(glm::dvec3(std::nan("")), point, back));
}

INSTANTIATE_TEST_SUITE_P(StraightLinearStraightQuadraticCurved, Finder, testing::Values(1, 2, 3));

TEST(ElementFinder, PicksTheCopyNextToTheSkin) {
  // Two coincident slabs, as after a cut: same rest positions, separate nodes.
  TetMesh mesh = test::SlabMesh(2, {2, 2, 2});
  const TetMesh one = mesh;
  const int nodes = static_cast<int>(one.rest_positions.size());
  mesh.rest_positions.insert(mesh.rest_positions.end(), one.rest_positions.begin(),
                             one.rest_positions.end());
  for (int node : one.elements) mesh.elements.push_back(node + nodes);
  const ElementFinder finder(mesh);
  const glm::dvec3 x(0.002, 0.003, -0.001);
  const int first = finder.Find(x).element;
  EXPECT_LT(first, one.ElementCount()) << "the first copy by default";
  for (int copy : {0, 1}) {
    const std::array<int, 1> beside{first + copy * one.ElementCount()};
    EXPECT_EQ(finder.FindBeside(x, beside).element, beside[0]);
  }
}

TEST(EmbeddedSkin, FollowsAffineMotionExactlyIncludingNormals) {
  const TetMesh mesh = test::BentMesh();
  const ElementFinder finder(mesh);
  SurfaceMesh surface = test::SlabSkin(1e-3);
  for (glm::dvec3& x : surface.vertices) x = test::Bent(x);
  const EmbeddedSkin skin = EmbedSkin(surface, mesh, finder);
  const glm::dmat3 a(1.1, 0.2, -0.1, 0.05, 0.9, 0.3, -0.2, 0.1, 1.2);
  std::vector<glm::dvec3> x;
  for (const glm::dvec3& rest : mesh.rest_positions) x.push_back(a * rest);
  std::vector<glm::dvec3> positions(skin.point.size()), normals(skin.point.size());
  DeformSkin(skin, mesh, x, positions, normals);
  double largest = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    largest = std::max(largest, glm::length(positions[v] - a * skin.rest.vertices[v]));
    EXPECT_NEAR(glm::length(normals[v]), 1.0, 1e-12);
  }
  EXPECT_LT(largest, 1e-14);
}

TEST(EmbeddedSkin, NormalsOfASphereAreRadial) {
  // Ball of 8 mm in a slab that contains it.
  const TetMesh mesh = test::SlabMesh(2, {4, 4, 4}, glm::dvec3(-0.01), glm::dvec3(0.01));
  const ElementFinder finder(mesh);
  const EmbeddedSkin skin = EmbedSkin(test::Sphere({0, 0, 0}, 0.008, 5), mesh, finder);
  std::vector<glm::dvec3> positions(skin.point.size()), normals(skin.point.size());
  DeformSkin(skin, mesh, mesh.rest_positions, positions, normals);
  double largest = 0, of_faces = 0;
  for (std::size_t v = 0; v < positions.size(); ++v)
    largest = std::max(largest, glm::length(normals[v] - glm::normalize(positions[v])));
  for (const auto& [a, b, c] : skin.rest.triangles) {
    const glm::dvec3 face =
        glm::normalize(glm::cross(positions[b] - positions[a], positions[c] - positions[a]));
    for (int corner : {a, b, c})
      of_faces = std::max(of_faces, glm::length(face - glm::normalize(positions[corner])));
  }
  std::printf("normals of a ball of 8192 triangles: error at most %.2e, of its faces %.2e\n",
              largest, of_faces);
  EXPECT_LT(largest, 0.5 * of_faces) << "errors of the faces around a vertex cancel";
}

TEST(EmbeddedSkin, DeformingAllocatesNothing) {
  const TetMesh mesh = test::SlabMesh(2, {8, 8, 3});
  const ElementFinder finder(mesh);
  const EmbeddedSkin skin = EmbedSkin(test::SlabSkin(3.2e-4), mesh, finder);
  std::vector<glm::dvec3> positions(skin.point.size()), normals(skin.point.size());
  const long before = test::Allocations();
  double best = 1e9;
  for (int i = 0; i < 20; ++i) {
    const double start = ThreadCpuMs();
    DeformSkin(skin, mesh, mesh.rest_positions, positions, normals);
    best = std::min(best, ThreadCpuMs() - start);
  }
  EXPECT_EQ(test::Allocations(), before);
  std::printf("skin of %zu vertices on %d T10: best %.3f ms\n", positions.size(),
              mesh.ElementCount(), best);
}

TEST(EmbeddedSkin, MeshWithoutElementsIsRefusedWithASentence) {
  const TetMesh mesh;
  const ElementFinder finder(mesh);
  try {
    EmbedSkin(test::SlabSkin(), mesh, finder);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadMesh);
    EXPECT_NE(error.sentence().find("tetrahedralize"), std::string::npos);
  }
}

}  // namespace
}  // namespace arthro::simulation
