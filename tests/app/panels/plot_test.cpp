// Axes of the figures in the window hold every curve, and can be drawn where there is none.
#include "app/panels/plot.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

// Axes that hold nothing yet, as those of paths.
Plot EmptyPlot() {
  Plot plot;
  plot.is_equal = true;
  plot.left = plot.low = std::numeric_limits<double>::max();
  plot.right = plot.high = std::numeric_limits<double>::lowest();
  return plot;
}

TEST(Plot, DotsAtTheEndsOfAPathHaveRoomOnEachSide) {
  Plot plot = EmptyPlot();
  plot.curves = {{{{-4, 1}, {6, 3}}}};
  FitAxes(plot);
  EXPECT_NEAR(plot.left, -4.5, 1e-6);
  EXPECT_NEAR(plot.right, 6.5, 1e-6);
  EXPECT_LT(plot.low, 0.95);
  EXPECT_GT(plot.high, 3.05);
}

TEST(Plot, ACurveOverTimeFillsTheWidth) {
  Plot plot;
  plot.right = 20;
  plot.curves = {{{{0, 1}, {20, 3}}}};
  FitAxes(plot);
  EXPECT_EQ(plot.left, 0);
  EXPECT_EQ(plot.right, 20);
}

TEST(Plot, PathsOfHandsThatWereNeverInsideHaveAxes) {
  Plot plot = EmptyPlot();
  plot.curves = {{{{0, kNoValue}, {0, kNoValue}}}};
  FitAxes(plot);
  // Steps along an axis end only where each of them is larger than a rounding.
  EXPECT_TRUE(std::isfinite(plot.right - plot.left) && std::isfinite(plot.high - plot.low));
  EXPECT_GT(plot.left + RoundStep(plot.right - plot.left, 5), plot.left);
  EXPECT_GT(plot.low + RoundStep(plot.high - plot.low, 5), plot.low);
}

}  // namespace
}  // namespace arthro::app
