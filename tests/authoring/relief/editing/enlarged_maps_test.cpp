#include "authoring/relief/editing/enlarged_maps.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

TEST(MapAtPictureSize, KeepsALinearReliefLinear) {
  DepthMap map(5, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) map.at(x, y) = static_cast<float>(x + 10 * y);
  const DepthMap large = MapAtPictureSize(map, 3);
  ASSERT_EQ(large.width, 15);
  ASSERT_EQ(large.height, 12);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_FLOAT_EQ(large.at(3 * x + 1, 3 * y + 1), map.at(x, y)) << "the cell's middle";
  EXPECT_FLOAT_EQ(large.at(5, 4), 1 + 1.0f / 3 + 10);
}

TEST(MapAtPictureSize, NeitherGrowsNorShrinksWhatIsUnknown) {
  DepthMap map(4, 4, 0.001f);
  map.at(2, 1) = std::numeric_limits<float>::quiet_NaN();
  const DepthMap large = MapAtPictureSize(map, 4);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_EQ(std::isnan(large.at(x, y)), x / 4 == 2 && y / 4 == 1) << x << ' ' << y;
}

TEST(MapAtPictureSize, OfOriginsHasTheOriginOfItsCell) {
  OriginMap map(2, 1, ReliefOrigin::kMeasured);
  map.at(1, 0) = ReliefOrigin::kInterpolated;
  const OriginMap large = MapAtPictureSize(map, 2);
  EXPECT_EQ(large.at(1, 1), ReliefOrigin::kMeasured);
  EXPECT_EQ(large.at(2, 0), ReliefOrigin::kInterpolated);
}

}  // namespace
}  // namespace arthro::authoring
