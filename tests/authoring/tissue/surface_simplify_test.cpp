#include "authoring/tissue/surface/surface_simplify.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/tissue/surface/surface_check.h"
#include "authoring/tissue/surface/surface_repair.h"
#include "tests/support/shapes.h"

namespace arthro::authoring {
namespace {

TEST(SurfaceSimplify, SphereStaysSoundAndNearTheOriginal) {
  const SurfaceMesh sphere = test::Sphere({0, 0, 0}, 0.015, 5);  // 8192 triangles
  for (const int most : {2000, 500}) {
    SurfaceMesh simple = sphere;
    const Simplification result = SimplifySurface(simple, most);
    const SurfaceCheck check = CheckSurface(simple);
    const double ball = 4.0 / 3 * std::numbers::pi * std::pow(0.015, 3);
    std::printf("%d -> %d triangles: %.3g mm off at most, volume off by %.2g %%\n",
                result.triangles_before, result.triangles_after, result.largest_distance * 1e3,
                100 * std::abs(check.volume / ball - 1));
    EXPECT_LE(result.triangles_after, most);
    EXPECT_GT(result.triangles_after, most * 9 / 10);
    EXPECT_TRUE(check.IsClosedManifold());
    EXPECT_EQ(check.self_intersections.count, 0);
    // n even triangles on a sphere have sides s with n s² √3/4 = 4 π r², and lie s²/(6 r) below it
    // at their centres; uneven ones up to three times that.
    const double square = 16 * std::numbers::pi * 0.015 * 0.015 / (std::sqrt(3.0) * most);
    EXPECT_LT(result.largest_distance, 3 * square / (6 * 0.015));
  }
}

TEST(SurfaceSimplify, SharpEdgesAndCornersStay) {
  // A box of fine squares needs only its corners.
  SurfaceMesh box;
  constexpr int n = 8;
  const auto add = [&](glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v) {
    const int first = static_cast<int>(box.vertices.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        box.vertices.push_back(origin + u * (i / double{n}) + v * (j / double{n}));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = first + i * (n + 1) + j, b = a + n + 1;
        box.triangles.push_back({a, b, b + 1});
        box.triangles.push_back({a, b + 1, a + 1});
      }
  };
  const glm::dvec3 x{0.01, 0, 0}, y{0, 0.01, 0}, z{0, 0, 0.01}, o{0, 0, 0};
  add(o, y, x), add(z, x, y), add(o, x, z), add(y, z, x), add(o, z, y), add(x, y, z);
  SurfaceMesh welded = RepairSurface(box, {}).surface;
  ASSERT_TRUE(CheckSurface(welded).IsClosedManifold());
  const Simplification result = SimplifySurface(welded, 60);
  EXPECT_LE(result.triangles_after, 60);
  EXPECT_LT(result.largest_distance, 1e-15);
  EXPECT_NEAR(CheckSurface(welded).volume, 1e-6, 1e-20);
}

TEST(SurfaceSimplify, SurfaceWithFewTrianglesIsUnchanged) {
  SurfaceMesh sphere = test::Sphere({0, 0, 0}, 0.015, 2);
  const SurfaceMesh before = sphere;
  EXPECT_EQ(SimplifySurface(sphere, 1000).largest_distance, 0);
  EXPECT_EQ(sphere.triangles, before.triangles);
}

}  // namespace
}  // namespace arthro::authoring
