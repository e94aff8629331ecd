#include "simulation/device/driver/rate_hand.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

const glm::dvec3 kMin(-0.2), kMax(0.2), kStill(0.0);

TEST(RateHand, AFullPushMovesAtFullSpeed) {
  RateHand hand;
  const RateOptions options;
  for (int i = 0; i < 1000; ++i) Advance(hand, {1, 0, -1}, kStill, 1e-3, kMin, kMax, options);
  EXPECT_LT(glm::distance(hand.position, glm::dvec3(options.speed, 0, -options.speed)), 1e-12);
  EXPECT_EQ(hand.orientation, glm::dquat(1, 0, 0, 0));
}

TEST(RateHand, RestsInTheDeadZoneAndStartsWithoutALeap) {
  EXPECT_EQ(Meant(0.06, 0.06), 0);
  EXPECT_EQ(Meant(-0.0599, 0.06), 0);
  EXPECT_NEAR(Meant(0.0601, 0.06), 0, 2e-4);
  EXPECT_EQ(Meant(1, 0.06), 1);
  EXPECT_EQ(Meant(-5, 0.06), -1);
  EXPECT_NEAR(Meant(-0.53, 0.06), -0.5, 1e-12);
  RateHand hand;
  for (int i = 0; i < 10000; ++i)
    Advance(hand, glm::dvec3(0.05), glm::dvec3(-0.05), 1e-3, kMin, kMax, {});
  EXPECT_EQ(hand.position, kStill);
  EXPECT_EQ(hand.orientation, glm::dquat(1, 0, 0, 0));
}

TEST(RateHand, StaysInItsBox) {
  RateHand hand;
  for (int i = 0; i < 100000; ++i) Advance(hand, {1, -1, 0}, kStill, 1e-3, kMin, kMax, {});
  EXPECT_EQ(hand.position, glm::dvec3(0.2, -0.2, 0));
}

TEST(RateHand, TurnsAboutTheAxesOfTheDeviceAndStaysUnit) {
  RateHand hand;
  const RateOptions options;
  const double quarter = 0.5 * std::numbers::pi / options.turn_speed;
  constexpr int kTicks = 1000;
  for (int axis : {2, 0}) {
    glm::dvec3 turn(0.0);
    turn[axis] = 1;
    for (int i = 0; i < kTicks; ++i)
      Advance(hand, kStill, turn, quarter / kTicks, kMin, kMax, options);
  }
  EXPECT_LT(glm::distance(hand.orientation * glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)), 1e-9);
  EXPECT_NEAR(glm::length(hand.orientation), 1, 1e-12);
}

TEST(RateHand, DoesNotLeapAfterAPauseOrNaN) {
  RateHand hand;
  Advance(hand, {1, 0, 0}, kStill, 60, kMin, kMax, {});
  EXPECT_LE(hand.position.x, 0.0081) << "a tenth of a second's way";
  const RateHand was = hand;
  const double bad = std::nan("");
  Advance(hand, glm::dvec3(bad), glm::dvec3(bad), 1e-3, kMin, kMax, {});
  for (const double dt : {0.0, -1.0, bad})
    Advance(hand, glm::dvec3(1), glm::dvec3(1), dt, kMin, kMax, {});
  EXPECT_EQ(hand.position, was.position);
  EXPECT_EQ(hand.orientation, was.orientation);
}

}  // namespace
}  // namespace arthro::simulation
