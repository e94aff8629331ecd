#include "simulation/haptics/output/thermal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;
constexpr double kPeak = 3.3;

TEST(Thermal, AllowsThePeakForABurstAndTheContinuousForceForALongPush) {
  const ThermalOptions options{0.88};
  ThermalState state;
  double full_for = 0, force = 0;
  for (int i = 0; i < 120000; ++i) {
    force = ThermalClamp(options, kPeak, state);
    if (force == kPeak) full_for += kTick;
    NoteHeat(options, force, kTick, state);
  }
  std::printf("3.3 N for %.2f s, %.3f N after two minutes\n", full_for, force);
  EXPECT_GT(full_for, 2.0) << "from cold: 0.75 * 0.88 N of mean takes 2.2 s at 3.3 N";
  EXPECT_LT(full_for, 2.5);
  EXPECT_LE(force, 0.88);
  EXPECT_GT(force, 0.9 * 0.88);
}

TEST(Thermal, DoesNotLowerForcesBelowTheContinuousForce) {
  const ThermalOptions options{0.88};
  ThermalState state;
  for (int i = 0; i < 60000; ++i) {
    ASSERT_GE(ThermalClamp(options, kPeak, state), 0.83);
    NoteHeat(options, 0.83, kTick, state);
  }
}

TEST(Thermal, DoesNotLowerForcesWithoutAMotor) {
  ThermalState state;
  NoteHeat({}, 1e6, 10.0, state);
  EXPECT_EQ(ThermalClamp({}, kPeak, state), kPeak);
  const ThermalOptions strong{5.0};
  EXPECT_EQ(ThermalClamp(strong, kPeak, state), kPeak) << "the peak is below what it bears";
}

TEST(Thermal, HandlesLongTicksAndNaN) {
  const ThermalOptions options{0.88};
  ThermalState fine, coarse;
  for (int i = 0; i < 1000; ++i) NoteHeat(options, 2.0, kTick, fine);
  NoteHeat(options, 2.0, 1.0, coarse);
  EXPECT_NEAR(fine.mean, coarse.mean, 1e-12);
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    NoteHeat(options, bad, kTick, fine);
    NoteHeat(options, 1.0, bad, fine);
  }
  NoteHeat(options, 1.0, -1.0, fine);
  EXPECT_EQ(fine.mean, fine.mean);
  EXPECT_NEAR(fine.mean, coarse.mean, 1e-12);
}

}  // namespace
}  // namespace arthro::simulation
