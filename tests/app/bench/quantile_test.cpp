#include "app/bench/quantile.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

TEST(Quantile, IsTheValueThatSoManyDoNotExceed) {
  std::vector<double> values(200);
  std::iota(values.begin(), values.end(), 1.0);
  std::shuffle(values.begin(), values.end(), std::mt19937(3));
  EXPECT_EQ(Quantile(values, 0.5), 100);
  EXPECT_EQ(Quantile(values, 0.99), 198);
  EXPECT_EQ(Quantile(values, 0.0), 1);
  EXPECT_EQ(Quantile(values, 1.0), 200);
}

TEST(Quantile, OfFewerThanAHundredTheLargestIsThe99thPercentile) {
  EXPECT_EQ(Quantile({7}, 0.5), 7);
  EXPECT_EQ(Quantile({3, 9, 1}, 0.99), 9);
  EXPECT_EQ(Quantile({3, 9, 1}, 0.5), 3);
}

}  // namespace
}  // namespace arthro::app
