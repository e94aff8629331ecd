// Steps of a noisy relief: connected lines that are large against the noise.
#include "simulation/haptics/relief/relief_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

constexpr int kSide = 256;
constexpr float kSigma = 3e-4f, kPixel = 1e-4f, kSmoothing = 10;  // m, m, px

std::vector<float> Heights(const std::function<double(double, double)>& height) {
  std::vector<float> heights;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) heights.push_back(static_cast<float>(height(x, y)));
  return heights;
}

std::vector<float> Everywhere(float value) {
  return std::vector<float>(static_cast<std::size_t>(kSide) * kSide, value);
}

std::vector<float> Near(const std::vector<float>& heights) {
  return NearSteps(kSide, kSide, heights, Everywhere(kSigma), Everywhere(kSmoothing),
                   Everywhere(kPixel));
}

// Height of a step that rises over `width` pixels along a line that falls by 0.3.
double Ramp(double x, double y, double width, double height) {
  const double beyond = (0.3 * (x - 128) + (y - 128)) / std::hypot(1.0, 0.3);
  return height * std::clamp(0.5 + beyond / width, 0.0, 1.0);
}

TEST(ReliefSteps, AStepIsFoundAlongItsWholeLengthAlsoWhenItIsBlurred) {
  for (const double width : {1.0, 4.0, 8.0}) {
    const std::vector<float> near =
        Near(Heights([=](double x, double y) { return Ramp(x, y, width, 10 * kSigma); }));
    ASSERT_FALSE(near.empty()) << width;
    int beside = 0, far = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double away = std::abs(0.3 * (x - 128) + (y - 128)) / std::hypot(1.0, 0.3);
        const float found = near[static_cast<std::size_t>(y * kSide + x)];
        beside += away < 2 * kSmoothing && found < 1 ? 1 : 0;
        far += away > 60 && found > 0 ? 1 : 0;
      }
    EXPECT_EQ(beside, 0) << width;
    EXPECT_EQ(far, 0) << width;
  }
}

TEST(ReliefSteps, LowStepsSlopesAndShortOnesAreNone) {
  const auto is_none = [](const std::function<double(double, double)>& height) {
    return Near(Heights(height)).empty();
  };
  EXPECT_TRUE(is_none([](double x, double y) { return Ramp(x, y, 1, 3 * kSigma); })) << "low";
  EXPECT_TRUE(is_none([](double x, double) { return 0.8 * kPixel * x; })) << "a slope";
  EXPECT_TRUE(is_none([](double x, double y) {
    return std::hypot(x - 128, y - 128) < 0.3 * 4 * kSmoothing ? 20 * kSigma : 0.0;
  })) << "a bump that is narrow against the smoothing";
  EXPECT_FALSE(is_none([](double x, double y) {
    return std::hypot(x - 128, y - 128) < 4 * kSmoothing ? 20 * kSigma : 0.0;
  })) << "a wide part in front";
}

// Noise whose extremes exceed the least height of a step here and there has no line of it.
TEST(ReliefSteps, NoiseHasNone) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const int cell : {6, 12, 24}) {  // px; finer noise is smoothed before
    constexpr int kMost = kSide + 2;
    std::vector<double> knots(static_cast<std::size_t>(kMost) * kMost);
    for (double& knot : knots) knot = 1.5 * kSigma * normal(random);
    const std::vector<float> near = Near(Heights([&](double x, double y) {
      // Bilinear between knots `cell` pixels apart.
      const int i = static_cast<int>(x) / cell, j = static_cast<int>(y) / cell;
      const double f = x / cell - i, g = y / cell - j;
      const auto at = [&](int u, int v) { return knots[static_cast<std::size_t>(v * kMost + u)]; };
      return (1 - g) * ((1 - f) * at(i, j) + f * at(i + 1, j)) +
             g * ((1 - f) * at(i, j + 1) + f * at(i + 1, j + 1));
    }));
    EXPECT_TRUE(near.empty()) << cell;
  }
}

TEST(ReliefSteps, UnknownHeightsAreNoStep) {
  std::vector<float> heights = Heights([](double x, double) { return x < 128 ? 0.0 : 0.01; });
  for (int y = 0; y < kSide; ++y)
    for (int x = 110; x < 146; ++x) heights[static_cast<std::size_t>(y * kSide + x)] = NAN;
  EXPECT_TRUE(Near(heights).empty());
}

}  // namespace
}  // namespace arthro::simulation
