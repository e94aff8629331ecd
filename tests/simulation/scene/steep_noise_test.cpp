#include "simulation/scene/backdrop/steep_noise.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace arthro {
namespace {

// Pixels of 0.29 mm on a sphere of 50 mm.
Backdrop Around() {
  Backdrop backdrop;
  backdrop.radius = 0.05;
  backdrop.projection = {ProjectionType::kEquirectangular, {299.5, 199.5}, 1000, 3};
  return backdrop;
}

// Hills of 5 mm with a step of 8 mm across each.
DepthMap Hills() {
  DepthMap depth(600, 400);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x)
      depth.at(x, y) = static_cast<float>(0.01 + 5e-3 * std::sin(x / 20.0) * std::cos(y / 30.0) +
                                          (x / 50 % 2 == 0 ? 8e-3 : 0));
  return depth;
}

DepthMap WithNoise(DepthMap depth, float sigma) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, sigma);
  for (float& h : depth.relief) h += noise(random);
  return depth;
}

// VIEW-03.
TEST(SteepNoise, IsMeasuredBetweenHillsAndSteps) {
  for (const float sigma : {0.5e-3f, 1e-3f, 3e-3f}) {
    const auto noise = SteepNoise(WithNoise(Hills(), sigma), Around());
    ASSERT_TRUE(noise) << sigma;
    // A median of 60,000 normal differences has a standard error of 0.5 %; the hills add 5 % at
    // 0.5 mm by their own bend.
    EXPECT_NEAR(*noise / sigma, 1.0, 0.07) << sigma;
  }
}

TEST(SteepNoise, IsNothingOnASurface) {
  EXPECT_FALSE(SteepNoise(Hills(), Around()));
  EXPECT_FALSE(SteepNoise(WithNoise(Hills(), 0.1e-3f), Around())) << "a third of a pixel";
  EXPECT_FALSE(SteepNoise(DepthMap(600, 400, 0.01f), Around()));
}

TEST(SteepNoise, HasNoOpinionOfFewPixels) {
  EXPECT_FALSE(SteepNoise({}, Around()));
  EXPECT_FALSE(SteepNoise(DepthMap(1, 1, 0.01f), Around()));
  EXPECT_FALSE(SteepNoise(DepthMap(40, 40, std::numeric_limits<float>::quiet_NaN()), Around()));
}

}  // namespace
}  // namespace arthro
