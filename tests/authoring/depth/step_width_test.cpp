#include "authoring/depth/steps/step_width.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "simulation/core/random.h"

namespace arthro::authoring {
namespace {

constexpr float kHigh = 0.020f;      // m
constexpr double kSteepest = 0.001;  // m per px
constexpr double kRounding = 2e-8;   // m

DepthMap Step() {
  DepthMap depth(120, 9, 0.0f);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 60; x < depth.width; ++x) depth.at(x, y) = kHigh;
  return depth;
}

// Least envelopes by their definition, over all pairs of pixels: a row, whose ways are straight.
double MeanOfEnvelopes(const DepthMap& row, int x) {
  double below = 1, above = -1;
  for (int i = 0; i < row.width; ++i) {
    below = std::min(below, static_cast<double>(row.at(i, 0)) + kSteepest * std::abs(i - x));
    above = std::max(above, static_cast<double>(row.at(i, 0)) - kSteepest * std::abs(i - x));
  }
  return 0.5 * (below + above);
}

TEST(StepWidth, AStepBecomesASlopeOfHalfTheSteepest) {
  DepthMap depth = Step();
  LimitSteepness(depth, kSteepest);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) {
      const double from_step = x - 59.5;
      const double expected =
          std::clamp(0.5 * kHigh + 0.5 * kSteepest * from_step, 0.0, static_cast<double>(kHigh));
      EXPECT_NEAR(depth.at(x, y), expected, 0.3 * kSteepest) << x;
      const float before = depth.at(std::max(x - 1, 0), y);
      EXPECT_LE(depth.at(x, y) - before, kSteepest + kRounding) << x;
    }
}

TEST(StepWidth, ARowIsTheMeanOfItsEnvelopes) {
  Random random(7);
  DepthMap row(200, 1);
  for (float& relief : row.relief) relief = static_cast<float>(random.Uniform(0, 0.02));
  DepthMap limited = row;
  LimitSteepness(limited, kSteepest);
  for (int x = 0; x < row.width; ++x)
    EXPECT_NEAR(limited.at(x, 0), MeanOfEnvelopes(row, x), kRounding) << x;
}

TEST(StepWidth, NoiseInThePlaneIsNowhereSteeper) {
  Random random(8);
  DepthMap depth(61, 47);
  for (float& relief : depth.relief) relief = static_cast<float>(random.Uniform(0, 0.02));
  LimitSteepness(depth, kSteepest);
  for (int y = 1; y < depth.height; ++y)
    for (int x = 1; x < depth.width; ++x) {
      EXPECT_LE(std::abs(depth.at(x, y) - depth.at(x - 1, y)), kSteepest + kRounding);
      EXPECT_LE(std::abs(depth.at(x, y) - depth.at(x, y - 1)), kSteepest + kRounding);
      EXPECT_LE(std::abs(depth.at(x, y) - depth.at(x - 1, y - 1)), 1.4143 * kSteepest + kRounding);
    }
}

TEST(StepWidth, WhatIsNoSteeperStaysBitForBit) {
  DepthMap depth(50, 40);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x)
      depth.at(x, y) = 0.01f + static_cast<float>(4e-4 * x + 3e-4 * y);
  const DepthMap before = depth;
  LimitSteepness(depth, kSteepest);
  EXPECT_EQ(depth.relief, before.relief);
  DepthMap step = Step();
  for (const double none : {0.0, -1.0, std::nan("")}) {
    LimitSteepness(step, none);
    EXPECT_EQ(step.relief, Step().relief) << none;
  }
}

// A wall of unknown pixels parts two areas, and neither changes the other.
TEST(StepWidth, UnknownPixelsStayAndNothingReachesThroughThem) {
  DepthMap depth = Step();
  for (int y = 0; y < depth.height; ++y) depth.at(60, y) = std::numeric_limits<float>::quiet_NaN();
  LimitSteepness(depth, kSteepest);
  for (int y = 0; y < depth.height; ++y) {
    EXPECT_TRUE(std::isnan(depth.at(60, y)));
    EXPECT_EQ(depth.at(59, y), 0.0f);
    EXPECT_EQ(depth.at(61, y), kHigh);
  }
  DepthMap none;
  LimitSteepness(none, kSteepest);
  DepthMap one(1, 1, 0.01f);
  LimitSteepness(one, kSteepest);
  EXPECT_EQ(one.at(0, 0), 0.01f);
}

}  // namespace
}  // namespace arthro::authoring
