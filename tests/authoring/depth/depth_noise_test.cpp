// Noise that a relief from brightness states, against noise of known size.
#include "authoring/depth/noise/depth_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

constexpr int kWidth = 400, kHeight = 300, kTexture = 16;

// A relief with a slope and a step of 8 mm, and white noise of the standard deviation
// `noise` at its left and twice that at its right.
DepthMap Noisy(float noise) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  DepthMap depth(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float side = x < kWidth / 2 ? 1.0f : 2.0f;
      depth.at(x, y) = 1e-5f * static_cast<float>(x) + 2e-5f * static_cast<float>(y) +
                       (y + x / 3 > 330 ? 8e-3f : 0.0f) + side * noise * normal(random);
    }
  return depth;
}

TEST(DepthNoise, IsThatOfTheFineStructureWhateverTheShape) {
  constexpr float kNoise = 3e-4f;
  const DepthMap sigma = NoiseOfDepth(Noisy(kNoise), kTexture);
  ASSERT_EQ(sigma.width, kWidth);
  // The mean has 1/(2 n √π) of the noise itself, 2 %. A window has 9216 pixels, so its median is
  // off by 1.2/√9216 at random; three of these.
  for (const auto& [x, side] : {std::pair{110, 1.0f}, std::pair{290, 2.0f}})
    for (int y = 80; y <= 120; y += 10)  // further than a window from step and border
      EXPECT_NEAR(sigma.at(x, y) / (side * kNoise), 1.0, 0.06) << x << ' ' << y;
}

TEST(DepthNoise, ReachesNoFurtherThanTwiceTheUsualOne) {
  DepthMap depth = Noisy(2e-4f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 100; ++x) depth.at(x, y) = 0.0f;  // saturated
  const DepthMap sigma = NoiseOfDepth(depth, kTexture);
  const auto [least, most] = std::minmax_element(sigma.relief.begin(), sigma.relief.end());
  EXPECT_GT(*least, 0.0f);
  EXPECT_LE(*most, 4.001f * *least);
}

TEST(DepthNoise, UnknownDepthsHaveNone) {
  DepthMap depth = Noisy(1e-4f);
  depth.at(30, 40) = std::numeric_limits<float>::quiet_NaN();
  const DepthMap sigma = NoiseOfDepth(depth, kTexture);
  int unknown = 0;
  for (const float s : sigma.relief) unknown += std::isnan(s) ? 1 : 0;
  EXPECT_EQ(unknown, 1);
  EXPECT_TRUE(std::isnan(sigma.at(30, 40)));
}

TEST(DepthNoise, IsNotStatedWhereThereIsNone) {
  EXPECT_TRUE(NoiseOfDepth({}, kTexture).empty());
  EXPECT_TRUE(NoiseOfDepth(DepthMap(1, 1, 0.01f), kTexture).empty());
  EXPECT_TRUE(NoiseOfDepth(DepthMap(40, 30, 0.01f), kTexture).empty());
  EXPECT_TRUE(
      NoiseOfDepth(DepthMap(40, 30, std::numeric_limits<float>::quiet_NaN()), kTexture).empty());
  EXPECT_TRUE(NoiseOfDepth(Noisy(1e-4f), 0).empty());
}

}  // namespace
}  // namespace arthro::authoring
