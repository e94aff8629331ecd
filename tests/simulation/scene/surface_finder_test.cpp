#include "simulation/scene/mesh/surface_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/core/units.h"
#include "tests/support/shapes.h"

namespace arthro {
namespace {

const glm::dvec3 kHalf = glm::dvec3(6, 4, 2) * kMm;

TEST(SurfaceFinder, FindsTheNearestPointOfAllTriangles) {
  const SurfaceMesh ball = test::Sphere({0, 0, 0}, 5 * kMm, 4);
  const SurfaceFinder surface(ball);
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 x{random.Uniform(-8, 8) * kMm, random.Uniform(-6, 6) * kMm,
                       random.Uniform(-4, 4) * kMm};
    double least2 = 1.0;
    for (std::size_t t = 0; t < ball.triangles.size(); ++t)
      least2 = std::min(least2, Distance2(CornersOf(ball, t), x));
    EXPECT_NEAR(glm::distance(surface.Nearest(x), x), std::sqrt(least2), 1e-15);
  }
}

TEST(SurfaceFinder, ReturnsThePointItselfWhenNothingIsInReach) {
  const SurfaceFinder box(test::Box(-kHalf, kHalf));
  const glm::dvec3 inside(0, 0, 1 * kMm), near(0, 0, 1.8 * kMm);
  EXPECT_EQ(box.Nearest(inside, 0.3 * kMm), inside);
  EXPECT_LT(glm::distance(box.Nearest(near, 0.3 * kMm), glm::dvec3(0, 0, 2 * kMm)), 1e-15);
  EXPECT_EQ(SurfaceFinder(SurfaceMesh{}).Nearest(inside, 1.0), inside);
}

}  // namespace
}  // namespace arthro
