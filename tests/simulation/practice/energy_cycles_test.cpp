// Energy that a hand gains over slow closed cycles on rigid backdrops, at the force that its device
// gets. `arthroscene bench haptics` tries 10 000 of the same cycles.
#include "tests/support/haptics/energy_cycles.h"

#include <cstdio>

#include <gtest/gtest.h>

namespace arthro::test {
namespace {

// Bound: less than 1 mJ between any two moments without a force.
TEST(EnergyOfSlowCycles, IsBelowOneMillijouleOnEveryGround) {
  constexpr int kCycles = 120;
  for (const EnergyRow& row : MeasureEnergy(kCycles, {})) {
    std::printf("%-40s %d of %d cycles touch; cycle %llu gains most: %.3f mJ at %.0f mm/s\n",
                row.ground.c_str(), row.touched, row.cycles,
                static_cast<unsigned long long>(row.worst), 1e3 * row.cycle.gain,
                1e3 * row.cycle.speed);
    EXPECT_GT(row.touched, row.cycles / 2) << row.ground;
    EXPECT_LT(row.cycle.gain, 1e-3) << row.ground;
    EXPECT_LE(row.largest_rise, 0.3 + 1e-9) << row.ground << ": N in a tick, the limiter's rise";
  }
}

}  // namespace
}  // namespace arthro::test
