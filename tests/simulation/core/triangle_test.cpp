#include "simulation/core/geometry/triangle.h"

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(Triangle, DistanceIsThatToFaceSideAndCorner) {
  const TriangleCorners corner{glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
  EXPECT_DOUBLE_EQ(Distance2(corner, {1, 1, 3}), 9);
  EXPECT_DOUBLE_EQ(Distance2(corner, {2, -3, 4}), 25);
  EXPECT_DOUBLE_EQ(Distance2(corner, {-2, -2, 1}), 9);
  EXPECT_DOUBLE_EQ(Distance2(corner, {3, 3, 0}), 2);
}

}  // namespace
}  // namespace arthro
