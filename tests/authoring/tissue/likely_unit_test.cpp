// The unit of a surface file by its size.
#include "authoring/tissue/likely_unit.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/small_scene.h"

namespace arthro::authoring {
namespace {

TEST(LikelyUnit, GivesAModelOfAJoint) {
  EXPECT_EQ(LikelyUnit(35), "mm");
  EXPECT_EQ(LikelyUnit(0.035), "m");
  EXPECT_EQ(LikelyUnit(3.5), "cm");
  EXPECT_EQ(LikelyUnit(80), "mm") << "a plateau";
  EXPECT_EQ(LikelyUnit(0.005), "m") << "a loose body";
  EXPECT_EQ(LikelyUnit(35000), "um");
}

TEST(LikelyUnit, AnUnlikelySizeIsMillimetres) {
  for (const double size : {0.0, 1e-9, 1e9, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    EXPECT_EQ(LikelyUnit(size), "mm") << size;
}

TEST(LikelyUnit, TheLongestSideIsThatOfTheBox) {
  SurfaceMesh mesh = test::Octahedron(5.0);
  for (auto& x : mesh.vertices) x = x * glm::dvec3(1, 3, 2) + 100.0;
  EXPECT_DOUBLE_EQ(LongestSide(mesh), 30.0);
  EXPECT_EQ(LongestSide({}), 0.0);
}

}  // namespace
}  // namespace arthro::authoring
