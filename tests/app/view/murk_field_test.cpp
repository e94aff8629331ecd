#include "app/view/disturbances/murk_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/support/view/slow_murk.h"

namespace arthro::app {
namespace {

// Largest difference of a byte of the field from double precision.
double WorstOf(int seed, double time) {
  const std::vector<std::uint8_t> field = MurkField(seed, time);
  double worst = 0;
  for (int j = 0; j < kMurkSize; ++j)
    for (int i = 0; i < kMurkSize; ++i) {
      const auto wanted =
          test::SlowMurk(seed, time, {(i + 0.5) / kMurkSize, (j + 0.5) / kMurkSize});
      const std::uint8_t* texel = &field[static_cast<std::size_t>(4 * (j * kMurkSize + i))];
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(texel[c] - 255 * wanted[c]));
      EXPECT_EQ(texel[3], 255);
    }
  return worst;
}

TEST(MurkField, IsTheNoiseOfItsPlaceWithinALevel) {
  for (const int seed : {0, 3})
    for (const double time : {0.0, 12.3, -77.7}) EXPECT_LT(WorstOf(seed, time), 1.0);
}

// Far out in the noise, single precision rounds a place by up to 0.03 cells of the finest drops,
// which are 0.4 of the dew and rise by at most 1.5 per cell: 5 levels.
TEST(MurkField, OfALargeSeedAndALateTimeIsTheSameWithinItsRounding) {
  for (const int seed : {1008, 2147483647})
    for (const double time : {0.0, 86400.0, -86400.0}) {
      const double worst = WorstOf(seed, time);
      std::printf("seed %d, %.0f s: at most %.1f levels from double precision\n", seed, time,
                  worst);
      EXPECT_LT(worst, 6.0);
    }
}

}  // namespace
}  // namespace arthro::app
