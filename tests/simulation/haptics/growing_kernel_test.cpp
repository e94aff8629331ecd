// Kernels that are even need no plane about a pixel; nothing that is uneven may be missed.
// missed.
#include "simulation/haptics/relief/growing_kernel.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "simulation/haptics/relief/plane_moments.h"

namespace arthro::simulation {
namespace {

constexpr int kWide = 203, kHigh = 121;  // no multiples of a block

std::size_t At(int x, int y) {
  return static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x);
}

// Chessboard distance to the nearest unknown pixel, pixel near a step, or the outside.
int DistanceAt(const DepthMap& depth, const Plane& near, int x, int y) {
  int least = std::min({x + 1, y + 1, kWide - x, kHigh - y});
  for (int v = 0; v < kHigh; ++v)
    for (int u = 0; u < kWide; ++u)
      if (!std::isfinite(depth.at(u, v)) || (!near.empty() && near[At(u, v)] > 0.0f))
        least = std::min(least, std::max(std::abs(u - x), std::abs(v - y)));
  return least;
}

TEST(EvenBlocks, AreNoFartherFromWhatIsUnevenThanTheirPixels) {
  std::mt19937 random(5);
  for (int holes = 0; holes < 4; ++holes) {
    DepthMap depth(kWide, kHigh, 0.01f);
    Plane near = holes == 0 ? Plane() : Plane(depth.relief.size(), 0.0f);
    for (int i = 0; i < holes; ++i) {
      depth.relief[random() % depth.relief.size()] = std::nanf("");
      near[random() % near.size()] = 0.1f;
    }
    const EvenBlocks blocks = EvenBlocksOf(depth, near);
    ASSERT_EQ(blocks.distance.size(), static_cast<std::size_t>(blocks.columns * blocks.rows));
    int farthest = 0;
    for (int y = 0; y < kHigh; y += 3)
      for (int x = 0; x < kWide; x += 3) {
        const int of_block = blocks.distance[static_cast<std::size_t>(
            y / EvenBlocks::kSide * blocks.columns + x / EvenBlocks::kSide)];
        EXPECT_LE(of_block, DistanceAt(depth, near, x, y)) << x << " " << y;
        farthest = std::max(farthest, of_block);
      }
    EXPECT_GT(farthest, EvenBlocks::kSide) << "no block is far from all of it";
  }
}

TEST(Growths, AreUnevenInTheirWindowsOnlyAsFarAsTheKernelReaches) {
  DepthMap depth(kWide, kHigh, 0.01f);
  const Plane deviation(depth.relief.size(), 3.0f);
  const PixelBounds wanted{90, 50, 110, 70};
  const std::vector<int> gaps = GapsOf(3.0);
  for (const Growth& growth :
       GrowthsOf(wanted, deviation, EvenBlocksOf(depth, {}), 0, gaps, kWide, kHigh)) {
    EXPECT_FALSE(growth.window.is_empty());
    EXPECT_TRUE(growth.uneven.is_empty());
  }
  depth.at(115, 60) = std::nanf("");  // 6 px beside what is wanted
  const auto growths = GrowthsOf(wanted, deviation, EvenBlocksOf(depth, {}), 0, gaps, kWide, kHigh);
  ASSERT_FALSE(growths.empty());
  EXPECT_FALSE(growths.back().uneven.is_empty());
  EXPECT_EQ(Joined(growths.back().uneven, growths.back().window), growths.back().window);
}

// The same bits, not only the same number: a part of a map then has the bytes of the whole.
TEST(PlaneMoments, OfAnEvenKernelGiveTheMean) {
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0.01f, 1e-3f);
  const MapFrame frame{1700, 900, 4096, 2047};
  Plane sums(static_cast<std::size_t>(kWide * kHigh)), scratch;
  for (float& height : sums) height = noise(random);
  PlaneMoments moments(Plane(sums.size(), 1.0f), sums, kWide, kHigh, frame);
  const PixelBounds whole{0, 0, kWide, kHigh};
  int reach = 0;
  for (const int gap : GapsOf(12.0)) {
    reach += gap;
    WidenOnTwoThreads(sums, kWide, kHigh, gap, {}, whole, scratch);
    WidenAll(moments.All(), kWide, kHigh, gap, {}, whole);
    ASSERT_GT(kHigh, 2 * reach);
    Plane planes(static_cast<std::size_t>(kWide - 2 * reach));
    for (int y = reach; y < kHigh - reach; ++y) {
      moments.PlanesAt(sums, y, reach, kWide - reach, planes.data());
      for (std::size_t i = 0; i < planes.size(); ++i)
        ASSERT_EQ(planes[i], sums[At(reach + static_cast<int>(i), y)]) << "gap " << gap;
    }
  }
}

}  // namespace
}  // namespace arthro::simulation
