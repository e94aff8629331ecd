// The relief that is drawn while the noise of a depth map is being removed.
#include "app/view/backdrop/rough_relief.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "app/view/backdrop/backdrop_texture.h"
#include "simulation/core/process_cost.h"
#include "simulation/haptics/relief/relief_smoothing.h"
#include "tests/app/view/lit_scene.h"

namespace arthro::test {
namespace {

using namespace app;

constexpr int kReliefWidth = 1200, kReliefHeight = 900;
constexpr float kError = 5e-4f;  // m
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Broad waves, and a step of 8 mm at x = 600.
float HeightAt(int x, int y) {
  return 0.006f +
         0.002f * std::sin(static_cast<float>(x) / 90) * std::cos(static_cast<float>(y) / 110) +
         (x < kReliefWidth / 2 ? 0.0f : 0.008f);
}

// Noise as that of a depth from brightness: alike over some pixels.
DepthMap NoisyMap() {
  constexpr int kAlike = 5;
  std::mt19937 random(11);
  std::normal_distribution<float> normal(0.0f, kError);
  DepthMap noise(kReliefWidth / kAlike + 1, kReliefHeight / kAlike + 1),
      map(kReliefWidth, kReliefHeight);
  for (float& value : noise.relief) value = normal(random);
  for (int y = 0; y < kReliefHeight; ++y)
    for (int x = 0; x < kReliefWidth; ++x)
      map.at(x, y) = HeightAt(x, y) + noise.at(x / kAlike, y / kAlike);
  return map;
}

// Rms distance from the truth, m, and that of the slopes along x, away from the step.
struct Off {
  double height, slope;
};
Off OffTruth(const DepthMap& map) {
  double heights = 0, slopes = 0;
  int count = 0;
  for (int y = 20; y < kReliefHeight - 20; ++y)
    for (int x = 20; x < kReliefWidth - 20; ++x) {
      if (std::abs(x - kReliefWidth / 2) < 40) continue;
      heights += std::pow(static_cast<double>(map.at(x, y) - HeightAt(x, y)), 2);
      slopes += std::pow(static_cast<double>(map.at(x + 1, y) - map.at(x, y) - HeightAt(x + 1, y) +
                                             HeightAt(x, y)),
                         2);
      ++count;
    }
  return {std::sqrt(heights / count), std::sqrt(slopes / count)};
}

// Before, the noise itself was drawn for the seconds that its removal takes: its slopes are what
// the eye sees.
TEST(RoughRelief, HasLittleOfTheNoiseAndTheStepAtItsPlace) {
  const DepthMap depth = NoisyMap(), sigma(kReliefWidth, kReliefHeight, kError);
  const Backdrop backdrop = PlainBackdrop(kReliefWidth, kReliefHeight);
  double start = ThreadCpuMs();
  const DepthMap rough = RoughRelief(depth, sigma, backdrop);
  const double rough_ms = ThreadCpuMs() - start;
  start = ThreadCpuMs();
  const DepthMap whole = simulation::WithoutNoise(depth, sigma, backdrop);
  const double whole_ms = ThreadCpuMs() - start;
  ASSERT_EQ(rough.width, kReliefWidth);
  const Off noisy = OffTruth(depth), quick = OffTruth(rough), best = OffTruth(whole);
  std::printf(
      "height off by %.0f um (noise), %.0f (rough), %.0f (whole); slope by %.1f um per "
      "px, %.2f, %.2f; %.0f ms against %.0f\n",
      1e6 * noisy.height, 1e6 * quick.height, 1e6 * best.height, 1e6 * noisy.slope,
      1e6 * quick.slope, 1e6 * best.slope, rough_ms, whole_ms);
  EXPECT_LT(quick.slope, 0.1 * noisy.slope);
  EXPECT_LT(quick.height, 0.5 * noisy.height);
  // Half of the step is reached within a block of its place.
  for (int y = 100; y < kReliefHeight - 100; y += 50) {
    const int reach = 2 * BlockSide(depth);
    const float below = rough.at(kReliefWidth / 2 - reach, y),
                above = rough.at(kReliefWidth / 2 + reach, y);
    EXPECT_GT(above - below, 0.006f) << y;
  }
}

TEST(RoughRelief, KeepsWhatIsUnknown) {
  DepthMap depth = NoisyMap();
  for (int y = 300; y < 420; ++y)
    for (int x = 200; x < 290; ++x) depth.at(x, y) = kUnknown;
  const DepthMap rough = RoughRelief(depth, DepthMap(kReliefWidth, kReliefHeight, kError),
                                     PlainBackdrop(kReliefWidth, kReliefHeight));
  for (int y = 0; y < kReliefHeight; ++y)
    for (int x = 0; x < kReliefWidth; ++x)
      ASSERT_EQ(std::isfinite(rough.at(x, y)), std::isfinite(depth.at(x, y))) << x << ' ' << y;
}

// Maps of one pixel, of nothing known, and of one row.
TEST(RoughRelief, HasTheSizeOfAnyMap) {
  const auto rough = [](int width, int height, float value) {
    return RoughRelief(DepthMap(width, height, value), DepthMap(width, height, kError),
                       PlainBackdrop(width, height));
  };
  EXPECT_NEAR(rough(1, 1, 0.01f).at(0, 0), 0.01f, 1e-6f);
  EXPECT_TRUE(std::isnan(rough(40, 30, kUnknown).at(3, 3)));
  EXPECT_NEAR(rough(5000, 1, 0.01f).at(7, 0), 0.01f, 1e-6f);
}

TEST(RoughRelief, DividesALargeMapIntoFewBlocks) {
  for (const int width : {10, 1000, 8192}) {
    const DepthMap map(width, width / 2, 0.01f);
    const int side = BlockSide(map), across = (map.width + side - 1) / side,
              down = (map.height + side - 1) / side;
    EXPECT_LE(across * down, kMostBlocks) << width;
  }
  EXPECT_EQ(BlockSide(DepthMap(10, 5, 0.01f)), 1);
}

}  // namespace
}  // namespace arthro::test
