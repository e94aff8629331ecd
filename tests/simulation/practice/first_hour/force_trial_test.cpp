// A force trial on a simulated hand: what it gives, what it measures, and how it ends.
#include "simulation/practice/first_hour/force_trial.h"

#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/tried_hand.h"

namespace arthro::simulation {
namespace {

using test::TriedHand;

ForceTrial Trial(const glm::dvec3& force, double limit = 1) {
  ForceTrial trial;
  trial.force = force;
  trial.limiter.max_force = limit;
  return trial;
}

TEST(ForceTrial, MovesTheHandBySpringAndForceAndEndsWithoutForce) {
  TriedHand hand;
  const TrialReport report = TryForce(hand.device, Trial({0, 1, 0}), hand.Ticks());
  EXPECT_EQ(report.end, TrialEnd::kDone);
  EXPECT_DOUBLE_EQ(report.largest, 1);
  EXPECT_NEAR(report.seconds, 2, 0.01);
  EXPECT_NEAR(report.rate, 1000, 10);
  // The hand's spring of 300 N/m holds 1 N less at most 0.26 N of friction.
  EXPECT_NEAR(report.moved.y, 1.0 / 300, 0.27 / 300);
  EXPECT_NEAR(report.moved.x, 0, 1e-4);
  EXPECT_EQ(hand.device.force(), glm::dvec3(0.0));
}

TEST(ForceTrial, GivesNeverMoreThanItsLimitNorRisesFaster) {
  TriedHand hand;
  for (const glm::dvec3& force : {glm::dvec3(0, 0, 100), glm::dvec3(1e9, -1e9, 0)}) {
    const ForceTrial trial = Trial(force, 0.5);
    const TrialReport report = TryForce(hand.device, trial, hand.Ticks());
    EXPECT_EQ(report.end, TrialEnd::kDone);
    EXPECT_LE(report.largest, 0.5 + 1e-9);
    EXPECT_GT(report.largest, 0.49);
    EXPECT_LE(report.steepest, trial.limiter.max_rise + 1e-6);
  }
}

TEST(ForceTrial, GivesNoForceThatIsNotANumber) {
  TriedHand hand;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(TryForce(hand.device, Trial({nan, 0, 0}), hand.Ticks()).largest, 0);
}

TEST(ForceTrial, WithoutADeadManNothingIsGiven) {
  TriedHand hand;
  hand.is_held = false;
  const TrialReport report = TryForce(hand.device, Trial({1, 0, 0}), hand.Ticks());
  EXPECT_EQ(report.end, TrialEnd::kNotArmed);
  EXPECT_EQ(report.largest, 0);
}

TEST(ForceTrial, ADeadManThatIsHeldFromTheStartDoesNotArm) {
  TriedHand hand;
  TrialTicks ticks = hand.Ticks();
  ticks.is_held = [](const DeviceSample&) { return true; };
  EXPECT_EQ(TryForce(hand.device, Trial({1, 0, 0}), ticks).end, TrialEnd::kNotArmed);
}

TEST(ForceTrial, AReleaseEndsTheForceInTheSameTick) {
  TriedHand hand;
  bool was_pushing = false;
  hand.event = [&](double now) {
    if (now < 1.5) was_pushing |= hand.device.force() != glm::dvec3(0.0);
    if (now >= 1.5 && now < 1.5015) hand.is_held = false;
    if (now >= 1.502) {
      EXPECT_EQ(hand.device.force(), glm::dvec3(0.0)) << now;
    }
  };
  EXPECT_EQ(TryForce(hand.device, Trial({1, 0, 0}), hand.Ticks()).end, TrialEnd::kReleased);
  EXPECT_TRUE(was_pushing);
}

TEST(ForceTrial, SilenceEndsTheForceWithinSixMilliseconds) {
  TriedHand hand;
  hand.event = [&](double now) { hand.device.SetSilent(now > 1.5); };
  const TrialReport report = TryForce(hand.device, Trial({1, 0, 0}), hand.Ticks());
  EXPECT_EQ(report.end, TrialEnd::kLost);
  EXPECT_GT(report.largest, 0.9);
  EXPECT_GT(report.silence, 0);
  EXPECT_LE(report.silence, 0.006 + kClockGrain);
}

TEST(ForceTrial, AFastHandGetsNoForce) {
  TriedHand hand;
  bool was_fast = false;
  hand.event = [&](double now) {
    if (now < 1.2) return;
    hand.device.plant().SetVelocity({0, 3, 0});
    was_fast |= now > 1.25;
    if (now > 1.25 && now < 1.9) {
      EXPECT_EQ(hand.device.force(), glm::dvec3(0.0)) << now;
    }
  };
  TryForce(hand.device, Trial({1, 0, 0}), hand.Ticks());
  EXPECT_TRUE(was_fast);
}

TEST(ForceTrial, TheProgramsEndEndsIt) {
  TriedHand hand;
  TrialTicks ticks = hand.Ticks();
  ticks.stops = [&] { return hand.now > 1; };
  EXPECT_EQ(TryForce(hand.device, Trial({1, 0, 0}), ticks).end, TrialEnd::kStopped);
  EXPECT_EQ(hand.device.force(), glm::dvec3(0.0));
}

}  // namespace
}  // namespace arthro::simulation
