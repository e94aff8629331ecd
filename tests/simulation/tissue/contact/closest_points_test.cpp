#include "simulation/tissue/contact/closest_points.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"

namespace arthro::simulation {
namespace {

glm::dvec3 At(const TriangleCorners& corner, const glm::dvec3& l) {
  return l.x * corner[0] + l.y * corner[1] + l.z * corner[2];
}

// Distance of a segment and a triangle by brute force: golden-section search along the segment of
// the (convex) distance to the triangle. That distance is the function under test for points, which
// the first test compares with a grid.
double BruteDistance(const glm::dvec3& a, const glm::dvec3& b, const TriangleCorners& corner) {
  const auto distance = [&](double t) {
    const glm::dvec3 x = a + t * (b - a);
    return glm::length(x - At(corner, ClosestOnTriangle(corner, x)));
  };
  double low = 0, high = 1;
  for (int i = 0; i < 200; ++i) {
    const double t1 = low + (high - low) * 0.382, t2 = low + (high - low) * 0.618;
    (distance(t1) < distance(t2) ? high : low) = distance(t1) < distance(t2) ? t2 : t1;
  }
  return distance(0.5 * (low + high));
}

TEST(ClosestPoints, NoPointOfTheTriangleIsNearer) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    TriangleCorners corner;
    const auto any = [&] {
      return glm::dvec3(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1));
    };
    for (glm::dvec3& x : corner) x = any();
    const glm::dvec3 x = 2.0 * any() - glm::dvec3(0.5);
    const glm::dvec3 l = ClosestOnTriangle(corner, x);
    EXPECT_NEAR(l.x + l.y + l.z, 1.0, 1e-12);
    EXPECT_GE(std::min({l.x, l.y, l.z}), -1e-12);
    const double distance = glm::length(x - At(corner, l));
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j + i <= 20; ++j) {
        const glm::dvec3 other(i / 20.0, j / 20.0, (20 - i - j) / 20.0);
        ASSERT_LE(distance, glm::length(x - At(corner, other)) + 1e-12);
      }
  }
}

TEST(ClosestPoints, SegmentAndTriangleDistanceEqualsBruteForce) {
  Random random(2);
  double largest = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    TriangleCorners corner;
    const auto any = [&] {
      return glm::dvec3(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1));
    };
    for (glm::dvec3& x : corner) x = any();
    const glm::dvec3 a = 1.5 * any(), b = 1.5 * any();
    const SegmentTriangle nearest = ClosestSegmentTriangle(a, b, corner);
    const double distance = std::sqrt(nearest.distance2);
    EXPECT_NEAR(distance, glm::length(a + nearest.along * (b - a) - At(corner, nearest.triangle)),
                1e-9);
    largest = std::max(largest, distance - BruteDistance(a, b, corner));
  }
  std::printf("segment to triangle: at most %.1e too far of 1\n", largest);
  EXPECT_LT(largest, 1e-9);
}

TEST(ClosestPoints, SegmentParallelToAFaceTouchesAtItsMiddle) {
  const TriangleCorners corner{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  const SegmentTriangle over = ClosestSegmentTriangle({-1, 1, 1}, {5, 1, 1}, corner);
  EXPECT_NEAR(over.along, 2.5 / 6.0, 1e-12) << "above the face between x = 0 and x = 3";
  EXPECT_NEAR(over.distance2, 1.0, 1e-12);
  const SegmentTriangle beside = ClosestSegmentTriangle({1, -1, 0.5}, {3, -1, 0.5}, corner);
  EXPECT_NEAR(beside.along, 0.5, 1e-12) << "along an edge";
  EXPECT_NEAR(beside.distance2, 1.25, 1e-12);
}

TEST(ClosestPoints, DegenerateShapesGiveFiniteResults) {
  const TriangleCorners flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
      dot{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  EXPECT_NEAR(ClosestSegmentTriangle({0, 1, 0}, {0, 1, 0}, flat).distance2, 1.0, 1e-12);
  EXPECT_NEAR(ClosestSegmentTriangle({1, 1, 0}, {1, 2, 0}, dot).distance2, 1.0, 1e-12);
  EXPECT_NEAR(ClosestSegmentTriangle({1, 1, 0}, {1, 1, 2}, dot).distance2, 0.0, 1e-12);
}

TEST(ClosestPoints, PointsInsideATetrahedronAreTheirOwnNearest) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::array<glm::dvec3, 4> corner;
    const auto any = [&] {
      return glm::dvec3(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1));
    };
    for (glm::dvec3& x : corner) x = any();
    const glm::dvec3 x = 1.4 * any() - glm::dvec3(0.2);
    const glm::dvec4 l = ClosestInTetrahedron(corner, x);
    EXPECT_NEAR(l.x + l.y + l.z + l.w, 1.0, 1e-9);
    const auto at = [&](const glm::dvec4& m) {
      return m.x * corner[0] + m.y * corner[1] + m.z * corner[2] + m.w * corner[3];
    };
    const double distance = glm::length(x - at(l));
    for (int i = 0; i < 200; ++i) {
      glm::dvec4 other(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1),
                       random.Uniform(0, 1));
      other /= other.x + other.y + other.z + other.w;
      ASSERT_LE(distance, glm::length(x - at(other)) + 1e-12);
    }
    std::swap(corner[0], corner[1]);
    EXPECT_NEAR(glm::length(x - at(ClosestInTetrahedron(corner, x))), distance, 1e-12);
  }
}

}  // namespace
}  // namespace arthro::simulation
