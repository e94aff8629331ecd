#include "authoring/relief/surface/enlarge_relief.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

constexpr float kNoRange = std::numeric_limits<float>::quiet_NaN();

TEST(EnlargedMap, IsLinearBetweenTheCells) {
  DepthMap map(6, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) map.at(x, y) = 1e-3f * static_cast<float>(x);
  const DepthMap large = EnlargedMap(map, 4, 1e-2f);
  ASSERT_EQ(large.width, 24);
  ASSERT_EQ(large.height, 16);
  for (int x = 4; x < 20; ++x) {
    const float cell = (static_cast<float>(x) + 0.5f) / 4 - 0.5f;  // pixel centres
    EXPECT_NEAR(large.at(x, 7), 1e-3f * cell, 1e-9f);
  }
}

TEST(EnlargedMap, KeepsAStepAndTheUnknownSharp) {
  DepthMap map(6, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) map.at(x, y) = x < 3 ? 0.0f : 0.012f;
  map.at(0, 0) = kNoRange;
  const DepthMap large = EnlargedMap(map, 4, 1e-3f);
  for (int x = 0; x < 24; ++x) EXPECT_EQ(large.at(x, 12), x < 12 ? 0.0f : 0.012f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) EXPECT_EQ(std::isnan(large.at(x, y)), x < 4 && y < 4);
}

TEST(EnlargedMap, RepeatsOrigins) {
  OriginMap map(2, 1);
  map.at(1, 0) = ReliefOrigin::kBrightness;
  const OriginMap large = EnlargedMap(map, 8);
  EXPECT_EQ(large.at(7, 7), ReliefOrigin::kNone);
  EXPECT_EQ(large.at(8, 0), ReliefOrigin::kBrightness);
}

}  // namespace
}  // namespace arthro::authoring
