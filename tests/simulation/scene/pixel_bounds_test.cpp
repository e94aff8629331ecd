#include "simulation/scene/pixel_bounds.h"

#include <cmath>

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(PixelBounds, OfADifferenceHoldAllDifferingPixelsAndNoMore) {
  DepthMap before(40, 30, 0.01f);
  before.at(3, 4) = std::nanf("");
  DepthMap after = before;
  EXPECT_TRUE(DifferenceOf(before, after).is_empty());
  after.at(7, 5) = 0.02f;
  EXPECT_EQ(DifferenceOf(before, after), (PixelBounds{7, 5, 8, 6}));
  after.at(39, 29) = std::nanf("");
  after.at(12, 2) = 0;
  EXPECT_EQ(DifferenceOf(before, after), (PixelBounds{7, 2, 40, 30}));
  EXPECT_EQ(DifferenceOf(DepthMap(), after), (PixelBounds{0, 0, 40, 30}));
}

TEST(PixelBounds, JoinAndGrowWithinTheMap) {
  EXPECT_EQ(Joined({}, {1, 2, 3, 4}), (PixelBounds{1, 2, 3, 4}));
  EXPECT_EQ(Joined({5, 0, 6, 1}, {1, 2, 3, 4}), (PixelBounds{1, 0, 6, 4}));
  EXPECT_EQ(Grown({1, 2, 9, 4}, 3, 10, 20), (PixelBounds{0, 0, 10, 7}));
}

}  // namespace
}  // namespace arthro
