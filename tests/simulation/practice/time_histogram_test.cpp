#include "simulation/practice/time_histogram.h"

#include <cmath>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TEST(TimeHistogram, QuantilesAreExactToOneThirtySecond) {
  TimeHistogram times;
  EXPECT_EQ(times.Quantile(0.5), 0.0);
  for (int i = 1; i <= 1000; ++i) times.Add(1e-6 * i);
  for (const double share : {0.5, 0.9, 0.99, 0.999}) {
    EXPECT_GE(times.Quantile(share), 1e-3 * share * 0.999);
    EXPECT_LE(times.Quantile(share), 1e-3 * share * std::exp2(1.0 / 32) * 1.001);
  }
  EXPECT_EQ(times.Quantile(1.0), 1e-3);
  EXPECT_EQ(times.largest(), 1e-3);
  EXPECT_EQ(times.count(), 1000);
}

TEST(TimeHistogram, AcceptsAnyDuration) {
  TimeHistogram times;
  for (const double bad : {std::nan(""), -1.0, 0.0, 1e300, HUGE_VAL}) times.Add(bad);
  EXPECT_EQ(times.count(), 5);
  EXPECT_GT(times.Quantile(0.99), 1.0);
  EXPECT_LT(times.Quantile(0.5), 1e-6);
}

}  // namespace
}  // namespace arthro::simulation
