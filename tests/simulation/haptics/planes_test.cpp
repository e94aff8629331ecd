#include "simulation/haptics/planes.h"

#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

PlaneSet SetOf(std::initializer_list<Plane> planes) {
  PlaneSet set;
  for (const Plane& plane : planes) set.Add(plane);
  return set;
}

TEST(Planes, FreeGoalIsReached) {
  const NearestFree free = NearestPoint(SetOf({{{0, 0, 1}, 0}}), {1, 2, 3}, {});
  EXPECT_EQ(free.nearest, glm::dvec3(1, 2, 3));
  EXPECT_EQ(free.push[0], 0.0);
}

TEST(Planes, OnePlaneGivesTheFoot) {
  const NearestFree free = NearestPoint(SetOf({{{0, 0, 1}, 0}}), {1, 2, -3}, {});
  EXPECT_EQ(free.nearest, glm::dvec3(1, 2, 0));
  EXPECT_EQ(free.push[0], 3.0);
}

TEST(Planes, ThreePlanesHoldInTheirCorner) {
  const PlaneSet set = SetOf({{{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}});
  const NearestFree free = NearestPoint(set, {-1, -2, -3}, {});
  EXPECT_LT(glm::length(free.nearest), 1e-15);
  EXPECT_NEAR(free.push[0], 1, 1e-12);
  EXPECT_NEAR(free.push[1], 2, 1e-12);
  EXPECT_NEAR(free.push[2], 3, 1e-12);
}

// Optimality of the nearest point of a convex set: feasible, pushes ≥ 0 only on active planes, and
// goal + Σ push·n is the point itself.
TEST(Planes, NearestPointIsOptimalForRandomPlanes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  int active = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    PlaneSet set;
    for (int i = 0; i < 1 + trial % 4; ++i) {
      const glm::dvec3 n = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
      set.Add({n, -0.1 * std::abs(any(random)), i, 1.0});  // keeps the origin free
    }
    const glm::dvec3 goal(any(random), any(random), any(random));
    const NearestFree free = NearestPoint(set, goal, {});
    glm::dvec3 sum = goal;
    for (int i = 0; i < set.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double height = glm::dot(set.plane[k].normal, free.nearest) - set.plane[k].offset;
      ASSERT_GE(height, -1e-9) << trial;
      ASSERT_GE(free.push[k], 0.0);
      if (free.push[k] > 0) {
        ASSERT_NEAR(height, 0.0, 1e-9) << trial;
        ++active;
      }
      sum += free.push[k] * set.plane[k].normal;
    }
    ASSERT_LT(glm::length(sum - free.nearest), 1e-9) << trial;
  }
  EXPECT_GT(active, 10000);
}

TEST(Planes, SamePlaneIsKeptOnce) {
  PlaneSet set = SetOf({{{0, 0, 1}, 0, 1}, {{0, 0, 1}, 0.5, 1}});
  EXPECT_EQ(set.count, 1);
  EXPECT_EQ(set.plane[0].offset, 0.5);
}

}  // namespace
}  // namespace arthro::simulation
