// Guard on a wall with a delay of one tick, touched by a simulated device with and without a hand.
#include "simulation/haptics/output/passivity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/device/hand_plant.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;

struct Touch {
  double swing = 0;      // m, of the last half second
  double work = 0;       // J, total work of the wall on the hand
  double rms_error = 0;  // N, of the force compared with the bare spring
};

// Two seconds against a one-sided wall at x = 0, one tick of delay, no friction, clamped to 3.3 N.
Touch TouchWall(double stiffness, const HandModel& hand, bool is_guarded,
                const PassivityOptions& options = {}) {
  HandPlant plant({0.045, 0.2, 0, 5.5e-5, 3.3, 1}, hand, {1e-3, 0, 0});
  plant.SetIntent({-5e-3, 0, 0});
  PassivityState guard;
  Touch touch;
  double low = 1, high = -1, error2 = 0;
  const int ticks = 2000;
  for (int i = 0; i < ticks; ++i) {
    const glm::dvec3 at = plant.Sample().hip_in_device;
    const glm::dvec3 spring(std::min(3.3, stiffness * std::max(0.0, -at.x)), 0, 0);
    glm::dvec3 force = spring;
    if (is_guarded) force = GuardPassivity(options, spring, at, stiffness, kTick, guard);
    if (const double length = glm::length(force); length > 3.3) force *= 3.3 / length;
    NoteSent(force, guard);
    error2 += glm::dot(force - spring, force - spring);
    plant.Tick(force, kTick);
    if (i >= ticks - 500) {
      low = std::min(low, plant.position().x);
      high = std::max(high, plant.position().x);
    }
  }
  touch.swing = high - low;
  touch.work = plant.work();
  touch.rms_error = std::sqrt(error2 / ticks);
  return touch;
}

TEST(Passivity, ReducesSwingAndEnergyOfATooStiffWall) {
  const Touch bare = TouchWall(4000, kHand, false), guarded = TouchWall(4000, kHand, true);
  std::printf("4000 N/m: swing %.2f -> %.2f mm\n", 1e3 * bare.swing, 1e3 * guarded.swing);
  EXPECT_GT(bare.swing, 0.3e-3) << "else there is nothing to guard against";
  EXPECT_LT(guarded.swing, 0.5 * bare.swing);
  EXPECT_LT(guarded.swing, 0.5e-3);
  // The guard works with the counts of the device too.
  PassivityOptions counts;
  counts.quantum = 5.5e-5;
  const Touch told = TouchWall(4000, kHand, true, counts);
  std::printf("told of the counts: %.2f mm\n", 1e3 * told.swing);
  EXPECT_LT(told.swing, 0.5e-3);
}

// A hand at rest on the edge between two counts, with a force one tick late: its apparent motion
// would soon add up to a debt. Then one count after a long rest, which looks fast.
TEST(Passivity, SingleEncoderCountsAreNotDamped) {
  constexpr double kCount = 5.5e-5;  // m
  PassivityOptions options;
  options.quantum = kCount;
  options.delay = 1;
  PassivityState guard;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 at(i % 2 * kCount, 0, 0);
    const glm::dvec3 spring(0.5 + 500 * kCount * (i % 2 == 0), 0, 0);
    ASSERT_EQ(GuardPassivity(options, spring, at, 500, kTick, guard), spring) << "tick " << i;
    NoteSent(spring, guard);
  }
  guard.energy = -1e-3;  // owed
  const glm::dvec3 push(0.5, 0, 0);
  for (int i = 0; i < 500; ++i) GuardPassivity(options, push, {0, 0, 0}, 500, kTick, guard);
  const glm::dvec3 braked = GuardPassivity(options, push, {2 * kCount, 0, 0}, 500, kTick, guard);
  EXPECT_LT(glm::distance(braked, push), 0.01) << "of 1.65 N at the speed of a count in a tick";
  EXPECT_LT(braked.x, push.x);
}

TEST(Passivity, DoesNotChangeAStableWall) {
  const Touch bare = TouchWall(500, kHand, false), guarded = TouchWall(500, kHand, true);
  std::printf("500 N/m: swing %.3f -> %.3f mm, force off by %.3f N rms\n", 1e3 * bare.swing,
              1e3 * guarded.swing, guarded.rms_error);
  EXPECT_LT(bare.swing, 0.1e-3);
  EXPECT_LT(guarded.rms_error, 0.02);
}

TEST(Passivity, ReturnsStoredEnergyWithoutDamping) {
  // Moves in and out of a spring: it returns exactly the energy that it took.
  PassivityState guard;
  double most = 0;
  for (int i = 0; i <= 200; ++i) {
    const double depth = 1e-3 * std::sin(3.14159265358979 * i / 200);
    const glm::dvec3 spring(500 * depth, 0, 0);
    const glm::dvec3 force = GuardPassivity({}, spring, {-depth, 0, 0}, 500, kTick, guard);
    NoteSent(force, guard);
    most = std::max(most, glm::length(force - spring));
  }
  EXPECT_EQ(most, 0.0);
}

TEST(Passivity, EnergyLostToFrictionGivesNoCredit) {
  PassivityState guard;
  // Half a joule of friction.
  for (int i = 0; i < 1000; ++i) {
    GuardPassivity({}, {0, 0, 1}, {1e-3 * i, 0, 0}, 500, kTick, guard);
    NoteSent({-0.5, 0, 1}, guard);
  }
  EXPECT_LE(guard.energy, 0.5 * 1.0 / 500 + 1e-15);
}

// Enters where the force is 0.3 of that at the exit, as with a lever or a fade at the edge of a
// map. The motion is slow, so that the damper is weak.
double GainOfALoop(bool is_bounded, double speed) {
  constexpr double kDeep = 0.02, kAcross = 0.03, kStiffness = 500, kClamp = 3.3;  // m, N/m, N
  PassivityState guard;
  glm::dvec3 force(0.0), last(0.0);
  double work = 0;
  const auto tick = [&](const glm::dvec3& hand) {
    work += glm::dot(force, hand - last);
    last = hand;
    const double gain = 0.3 + 0.7 * hand.y / kAcross;
    glm::dvec3 bare(kStiffness * gain * std::max(0.0, -hand.x), 0, 0);
    if (is_bounded)
      bare = BoundByCredit({}, bare, hand, {kStiffness * gain, kClamp}, false, kTick, guard);
    force = GuardPassivity({}, bare, hand, kStiffness * gain, kTick, guard);
    if (const double size = glm::length(force); size > kClamp) force *= kClamp / size;
    NoteSent(force, guard);
  };
  const double step = speed * kTick;
  double x = 1e-3, y = 0;
  for (; x > -kDeep; x -= step) tick({x, y, 0});
  for (; y < kAcross; y += step) tick({x, y, 0});
  for (; x < 1e-3; x += step) tick({x, y, 0});
  return work;
}

TEST(Passivity, ASpringThatIsStifferOnTheWayOutReturnsOnlyTheEnergyPaid) {
  for (const double speed : {0.02, 0.05, 0.15}) {
    const double bare = GainOfALoop(false, speed), bounded = GainOfALoop(true, speed);
    std::printf("%.2f m/s: %.2f mJ gained with the damper alone, %.3f mJ with the credit\n", speed,
                1e3 * bare, 1e3 * bounded);
    EXPECT_LT(bounded, 0.5e-3);
    if (speed < 0.03) {
      EXPECT_GT(bare, 1e-3) << "else there is nothing to bound";
    }
  }
}

TEST(Passivity, TheBoundIsContinuousAndKeepsAPaidSpring) {
  // The force stays at the clamp while the credit lasts, and falls steadily after it.
  const HandSpring spring{500, 3.3};
  double last = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double paid = spring.EnergyOf(10.0) * i / 2000;
    PassivityState guard;
    BoundByCredit({}, {10, 0, 0}, {}, spring, false, kTick, guard);
    guard.credit = paid;
    const double force =
        std::min(3.3, BoundByCredit({}, {10, 0, 0}, {}, spring, false, kTick, guard).x);
    EXPECT_GE(force, last - 1e-12);
    if (i > 0) {
      EXPECT_LT(force - last, 0.01) << paid;
    }
    last = force;
  }
  EXPECT_EQ(last, 3.3);
  PassivityState paid;
  BoundByCredit({}, {10, 0, 0}, {}, spring, false, kTick, paid);
  EXPECT_EQ(BoundByCredit({}, {10, 0, 0}, {}, spring, false, kTick, paid), glm::dvec3(10, 0, 0));
}

TEST(Passivity, HandlesAnyInputAndAllocatesNothing) {
  PassivityState guard;
  const long before = test::Allocations();
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300})
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 hand(0.0);
      hand[axis] = bad;
      GuardPassivity({}, {1, 0, 0}, hand, 500, kTick, guard);
      const glm::dvec3 after = GuardPassivity({}, {1, 0, 0}, glm::dvec3(0.0), 500, kTick, guard);
      EXPECT_TRUE(std::isfinite(after.x + after.y + after.z)) << bad;
      GuardPassivity({}, {1, 0, 0}, glm::dvec3(0.0), 500, 0.0, guard);
      BoundByCredit({}, {1, 0, 0}, hand, {500, 3.3}, false, kTick, guard);
      const glm::dvec3 bounded =
          BoundByCredit({}, {1, 0, 0}, glm::dvec3(0.0), {500, 3.3}, false, kTick, guard);
      EXPECT_TRUE(std::isfinite(bounded.x + bounded.y + bounded.z)) << bad;
    }
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace arthro::simulation
