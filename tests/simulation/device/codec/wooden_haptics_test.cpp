#include "simulation/device/codec/wooden_haptics.h"

#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"

namespace arthro::simulation {
namespace {

// Counters 1, −2, 300, −300, 32767, −32768 and a pressed button.
const std::vector<std::uint8_t> kGolden{0x01, 0x00, 0xfe, 0xff, 0x2c, 0x01, 0xd4,
                                        0xfe, 0xff, 0x7f, 0x00, 0x80, 0x01, 0x00};

TEST(WoodenHaptics, ReadsItsReport) {
  const auto report = ParseWooden(kGolden);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->encoder, (std::array<std::int16_t, 6>{1, -2, 300, -300, 32767, -32768}));
  EXPECT_EQ(report->info, 1);
  std::vector<std::uint8_t> padded = kGolden;
  padded.resize(64);
  ASSERT_TRUE(ParseWooden(padded));
  EXPECT_EQ(ParseWooden(padded)->encoder, report->encoder);
}

TEST(WoodenHaptics, HardCase04RejectsReportsOfAnotherLength) {
  for (const std::size_t length : {0, 1, 13, 15, 63, 65})
    EXPECT_FALSE(ParseWooden(std::vector<std::uint8_t>(length, 1))) << length;
}

TEST(WoodenHaptics, RemovesTheButtonOfAPolhemFromItsEncoder) {
  WoodenReport report;
  report.encoder[3] = 9988;
  EXPECT_TRUE(TakePolhemButton(report));
  EXPECT_EQ(report.encoder[3], -12);
  EXPECT_FALSE(TakePolhemButton(report));
  EXPECT_EQ(report.encoder[3], -12);
}

TEST(WoodenHaptics, WritesCurrentsInMilliamperesBehindTheReportId) {
  const WoodenOutput report = WoodenCurrentReport({0.3, -0.3, 1.5});
  const WoodenOutput golden{0, 0x2c, 0x01, 0xd4, 0xfe, 0xdc, 0x05, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(report, golden);
}

TEST(WoodenHaptics, SetsCountersOfArmAndGimbal) {
  const WoodenOutput report = WoodenCounterReport({1, 2, 3, 4, 5, -1});
  const WoodenOutput golden{0, 4, 0, 5, 0, 0xff, 0xff, 1, 0, 1, 0, 2, 0, 3, 0};
  EXPECT_EQ(report, golden);
}

TEST(WoodenHaptics, HardCase06NoForceChangesItsSignInSixteenBits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double amperes : {40.0, 1e6, 1e300, kInfinity}) {
    const WoodenOutput report = WoodenCurrentReport({amperes, -amperes, std::nan("")});
    EXPECT_EQ(SignedAt(report, 1), 32767) << amperes;
    EXPECT_EQ(SignedAt(report, 3), -32767) << amperes;
    EXPECT_EQ(SignedAt(report, 5), 0) << "not a number is no current";
  }
  const WoodenArm arm;
  const glm::dvec3 angles(0.2, 1.0, 1.2);
  for (const double newton : {1e-310, 1e6, 1e300}) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(1, -2, 0.5));
    const glm::dvec3 amperes = WoodenCurrents(arm, angles, newton * way);
    // The force of the motors, Jᵀ⁻¹ of their torques, has the direction of the command.
    const glm::dvec3 torque = amperes * arm.torque_constant / arm.transmission;
    const glm::dvec3 given = glm::inverse(glm::transpose(WoodenJacobian(arm, angles))) * torque;
    if (newton < 1) continue;
    EXPECT_GT(glm::dot(glm::normalize(given), way), 1 - 1e-12) << newton;
    EXPECT_NEAR(std::max({std::abs(amperes.x), std::abs(amperes.y), std::abs(amperes.z)}),
                arm.largest_current, 1e-12);
  }
  for (const double bad : {std::nan(""), kInfinity})
    EXPECT_EQ(WoodenCurrents(arm, angles, {0, bad, 0}), glm::dvec3(0.0));
}

TEST(WoodenHaptics, OneCountAndOneMilliampereMatchTheDesign) {
  const WoodenArm arm;
  const std::array<std::int64_t, 6> none{}, one{0, 1, 0, 0, 0, 0};
  const glm::dvec3 at = WoodenAngles(arm, none);
  const double step =
      glm::distance(WoodenPosition(arm, WoodenAngles(arm, one)), WoodenPosition(arm, at));
  EXPECT_NEAR(step, 0.054e-3, 0.001e-3) << "m";
  // 1 N up at the level upper link.
  const glm::dvec3 level(0, 0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  const glm::dvec3 amperes = WoodenCurrents(arm, level, {0, 0, 1});
  EXPECT_NEAR(1.0 / std::abs(1e3 * amperes.y), 1.5e-3, 0.1e-3) << "N a mA";
}

TEST(WoodenHaptics, TheJacobianIsTheDerivativeOfThePosition) {
  const WoodenArm arm;
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 angles{random.Uniform(-1, 1), random.Uniform(0.2, 2), random.Uniform(0.2, 2)};
    const glm::dmat3 jacobian = WoodenJacobian(arm, angles);
    for (int a = 0; a < 3; ++a) {
      constexpr double kStep = 1e-6;
      glm::dvec3 low = angles, high = angles;
      low[a] -= kStep, high[a] += kStep;
      const glm::dvec3 slope = (WoodenPosition(arm, high) - WoodenPosition(arm, low)) / (2 * kStep);
      EXPECT_LT(glm::distance(slope, jacobian[a]), 1e-9);
    }
  }
}

TEST(WoodenHaptics, AReversedMotorGivesTheSamePositionAndForce) {
  WoodenArm arm, turned;
  turned.sign = {-1, 1, -1};
  const std::array<std::int64_t, 6> counts{120, 900, 800, 10, -20, 30};
  const std::array<std::int64_t, 6> mirrored{-120, 900, -800, 10, -20, 30};
  const glm::dvec3 angles = WoodenAngles(arm, counts);
  EXPECT_EQ(WoodenAngles(turned, mirrored), angles);
  const glm::dvec3 force(0.3, -0.2, 0.7);
  EXPECT_LT(glm::distance(WoodenCurrents(arm, angles, force) * turned.sign,
                          WoodenCurrents(turned, angles, force)),
            1e-15);
}

TEST(WoodenHaptics, HandleOrientationFollowsTheJoints) {
  const WoodenArm arm;
  const double quarter = 0.5 * std::numbers::pi;
  const glm::dquat none = WoodenHandle(arm, {0, 0, quarter}, {});
  EXPECT_NEAR(std::abs(none.w), 1, 1e-15) << "A = 0, C = 90 deg, gimbal straight";
  const glm::dquat rolled = WoodenHandle(arm, {0, 0, quarter}, {0, 0, 0, 256, 0, 0});
  const glm::dvec3 y = rolled * glm::dvec3(0, 1, 0);
  EXPECT_LT(glm::distance(y, glm::dvec3(0, 0, 1)), 1e-12) << "256 of 1024 counts are a quarter";
}

TEST(EncoderUnwrap, HardCase05UnwrapsPastSixteenBits) {
  EncoderUnwrap unwrap(93);
  std::int64_t truth = 32000;
  const auto take = [&](std::int64_t count) {
    const auto low = static_cast<std::int16_t>(static_cast<std::uint16_t>(count & 0xffff));
    return unwrap.Take({low, low, low, 0, 0, 0});
  };
  ASSERT_TRUE(take(truth));
  for (int i = 0; i < 3000; ++i) ASSERT_TRUE(take(truth += 90)) << i;
  EXPECT_EQ(unwrap.total()[0], truth);
  for (int i = 0; i < 6000; ++i) ASSERT_TRUE(take(truth -= 93)) << i;
  EXPECT_EQ(unwrap.total()[2], truth);
}

TEST(EncoderUnwrap, HardCase05RejectsAFlippedBit) {
  for (int bit = 7; bit < 16; ++bit) {
    EncoderUnwrap unwrap(93);
    const std::array<std::int16_t, 6> still{100, 200, 300, 0, 0, 0};
    ASSERT_TRUE(unwrap.Take(still));
    std::array<std::int16_t, 6> flipped = still;
    flipped[1] = static_cast<std::int16_t>(flipped[1] ^ (1 << bit));
    EXPECT_FALSE(unwrap.Take(flipped)) << bit;
    EXPECT_EQ(unwrap.total()[1], 200) << bit;
    EXPECT_TRUE(unwrap.Take(still)) << bit;
    EXPECT_EQ(unwrap.total()[1], 200) << bit;
  }
}

TEST(EncoderUnwrap, AcceptsALeapThatTheNextReportConfirms) {
  EncoderUnwrap unwrap(93);
  ASSERT_TRUE(unwrap.Take({0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(unwrap.Take({500, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(unwrap.Take({510, 0, 0, 0, 0, 0})) << "after a stall the hand is elsewhere";
  EXPECT_EQ(unwrap.total()[0], 510);
}

}  // namespace
}  // namespace arthro::simulation
