#include "app/view/drawing/tissue_grain.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/vertex_normals.h"
#include "tests/support/shapes.h"

namespace arthro::app {
namespace {

using simulation::TissueStructure;
constexpr double kInner = 0.008, kOuter = 0.016, kHalfSweep = 2.0;  // m, rad

// Crescent about an axis of its own, with round ends left out: a sheet with two sides.
SurfaceMesh Crescent(const Pose& pose) {
  SurfaceMesh mesh;
  constexpr int kAlong = 120, kAcross = 12;
  for (const double z : {-0.001, 0.001})
    for (int i = 0; i <= kAlong; ++i)
      for (int j = 0; j <= kAcross; ++j) {
        const double a = kHalfSweep * (2.0 * i / kAlong - 1.0);
        const double r = kInner + (kOuter - kInner) * j / kAcross;
        mesh.vertices.push_back(pose * glm::dvec3(r * std::cos(a), r * std::sin(a), z));
      }
  return mesh;
}

class Poses : public testing::TestWithParam<Pose> {};

TEST_P(Poses, CrescentRunsFromFreeEdgeToRimAndFromEndToEnd) {
  const Pose& pose = GetParam();
  const TissueGrain grain(Crescent(pose), TissueStructure::kFibres);
  const auto at = [&](double r, double angle) {
    return grain.At(pose * glm::dvec3(r * std::cos(angle), r * std::sin(angle), 0), {0, 0, 1});
  };
  // The circle of a crescent that is no full ring lies off its axis, so that the radii of an edge
  // vary within a bin of angles, 1/96 of the crescent: by 0.3 % of the width here.
  constexpr double kBin = 3e-3;
  for (const double angle : {-1.5, -0.4, 0.0, 0.9, 1.6}) {
    EXPECT_NEAR(at(kInner, angle).rim, 0.0, kBin) << angle;
    EXPECT_NEAR(at(0.012, angle).rim, 0.5, kBin) << angle;
    EXPECT_NEAR(at(kOuter, angle).rim, 1.0, kBin) << angle;
    EXPECT_EQ(at(0.012, angle).root, 0.0) << angle;
  }
  // The ends are not radial about that circle: their corners lie half a millimetre apart.
  EXPECT_GT(at(0.012, kHalfSweep).root, 0.8);
  EXPECT_GT(at(0.012, -kHalfSweep).root, 0.8);
  // Along the fibres the coordinate grows by the length of the arc, either way round.
  const double way = at(0.012, 0.5).place.x - at(0.012, -0.5).place.x;
  EXPECT_NEAR(std::abs(way), 0.012, 0.1 * 0.012);
  EXPECT_NEAR(std::abs(glm::dot(grain.axis(), pose.quaternion * glm::dvec3(0, 0, 1))), 1.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    TissueGrain, Poses,
    testing::Values(Pose{}, Pose{{0.02, -0.01, 0.03},
                                 glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, -1))),
                                 1.0}));

// 14 stations along, their vertices not abreast: between two of them lie several angles of the
// crescent without a vertex of either edge. The fibres ran in zigzag there.
TEST(TissueGrain, FibresOfACoarseCrescentRunAlongIt) {
  constexpr int kAlong = 14, kAcross = 3;
  SurfaceMesh mesh;
  for (int i = 0; i <= kAlong; ++i)
    for (int j = 0; j <= kAcross; ++j) {
      const double a = kHalfSweep * (2.0 * (i + 0.3 * (j % 2)) / kAlong - 1.0);
      const double r = kInner + (kOuter - kInner) * j / kAcross;
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), 0.001 * (j % 2));
    }
  const auto at = [](int i, int j) { return i * (kAcross + 1) + j; };
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const TissueGrain grain(mesh, TissueStructure::kFibres);
  double least = 1, most = 0;
  for (double angle = -1.5; angle < 1.5; angle += 0.01) {
    const double rim =
        grain.At({0.012 * std::cos(angle), 0.012 * std::sin(angle), 0}, {0, 0, 1}).rim;
    least = std::min(least, rim), most = std::max(most, rim);
  }
  std::printf("across the fibres along a circle: %.3f to %.3f\n", least, most);
  // The chords of the stations lie up to 2 % of the width within either edge.
  EXPECT_NEAR(least, 0.5, 0.04);
  EXPECT_NEAR(most, 0.5, 0.04);
}

TEST(TissueGrain, PlateKnowsItsBorderAndItsSides) {
  SurfaceMesh plate = test::Sphere({0, 0, 0}, 1, 5);
  for (glm::dvec3& x : plate.vertices) x *= glm::dvec3(0.010, 0.008, 0.001);
  const TissueGrain grain(plate, TissueStructure::kHyaline);
  EXPECT_EQ(grain.At({0, 0, 0.001}, {0, 0, 1}).rim, 0.0);
  EXPECT_EQ(grain.At({0, 0, 0.001}, {0, 0, 1}).root, 0.0);
  EXPECT_NEAR(grain.At({0.010, 0, 0}, {1, 0, 0}).rim, 1.0, 1e-6);
  EXPECT_NEAR(grain.At({0, 0.008, 0}, {0, 1, 0}).root, 1.0, 1e-6);
}

TEST(TissueGrain, PlainOrEmptyTissueKeepsItsOwnCoordinates) {
  for (const TissueGrain& grain :
       {TissueGrain(), TissueGrain(SurfaceMesh{}, TissueStructure::kFibres)}) {
    EXPECT_EQ(grain.At({1, 2, 3}, {0, 0, 1}).place, glm::dvec3(1, 2, 3));
    EXPECT_EQ(grain.axis(), glm::dvec3(0.0));
  }
}

}  // namespace
}  // namespace arthro::app
