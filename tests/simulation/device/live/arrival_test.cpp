#include "simulation/device/live/arrival.h"

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TEST(Arrival, AnAwaitedReportIsNew) {
  EXPECT_EQ(ArrivalOf(1.000, 1.001, 1, 1e-3), 1.001);
  EXPECT_DOUBLE_EQ(ArrivalOf(1.000, 1.004, 1, 1e-3), 1.004) << "the answer to a servo of 250 Hz";
  EXPECT_EQ(ArrivalOf(1.000, 1.010, 10, 1e-3), 1.010) << "ten that waited ten milliseconds";
}

TEST(Arrival, HardCase01SixtyThreeReportsAfter300MillisecondsAreOld) {
  const double t = ArrivalOf(1.000, 1.300, 63, 1e-3);
  EXPECT_NEAR(1.300 - t, 0.300 - 0.063 - kArrivalSlack, 1e-12);
  EXPECT_GT(1.300 - t, 0.020) << "lost, not merely late";
}

}  // namespace
}  // namespace arthro::simulation
