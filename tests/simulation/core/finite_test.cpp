#include "simulation/core/finite.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(Finite, RejectsNanAndInfinityInAnyComponent) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_TRUE(IsFinite({kMax, kMax, -kMax})) << "the sum of the components is infinite";
  for (const double bad :
       {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()})
    for (int c = 0; c < 3; ++c) {
      std::vector<glm::dvec3> points(3, glm::dvec3(kMax));
      EXPECT_TRUE(AllFinite(points));
      points[1][c] = bad;
      EXPECT_FALSE(IsFinite(points[1]));
      EXPECT_FALSE(AllFinite(points));
    }
  EXPECT_TRUE(AllFinite({}));
}

}  // namespace
}  // namespace arthro
