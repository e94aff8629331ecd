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

constexpr int kMapWide = 203, kMapHigh = 121;  // no multiples of a block

std::size_t CellAt(int x, int y) {
  return static_cast<std::size_t>(y) * kMapWide + static_cast<std::size_t>(x);
}

// Chessboard distance to the nearest unknown pixel, pixel near a step, or the outside.
int DistanceAt(const DepthMap& depth, const FloatPlane& near, int x, int y) {
  int least = std::min({x + 1, y + 1, kMapWide - x, kMapHigh - y});
  for (int v = 0; v < kMapHigh; ++v)
    for (int u = 0; u < kMapWide; ++u)
      if (!std::isfinite(depth.at(u, v)) || (!near.empty() && near[CellAt(u, v)] > 0.0f))
        least = std::min(least, std::max(std::abs(u - x), std::abs(v - y)));
  return least;
}

TEST(EvenBlocks, AreNoFartherFromWhatIsUnevenThanTheirPixels) {
  std::mt19937 random(5);
  for (int holes = 0; holes < 4; ++holes) {
    DepthMap depth(kMapWide, kMapHigh, 0.01f);
    FloatPlane near = holes == 0 ? FloatPlane() : FloatPlane(depth.relief.size(), 0.0f);
    for (int i = 0; i < holes; ++i) {
      depth.relief[random() % depth.relief.size()] = std::nanf("");
      near[random() % near.size()] = 0.1f;
    }
    const EvenBlocks blocks = EvenBlocksOf(depth, near);
    ASSERT_EQ(blocks.distance.size(), static_cast<std::size_t>(blocks.columns * blocks.rows));
    int farthest = 0;
    for (int y = 0; y < kMapHigh; y += 3)
      for (int x = 0; x < kMapWide; x += 3) {
        const int of_block = blocks.distance[static_cast<std::size_t>(
            y / EvenBlocks::kSide * blocks.columns + x / EvenBlocks::kSide)];
        EXPECT_LE(of_block, DistanceAt(depth, near, x, y)) << x << " " << y;
        farthest = std::max(farthest, of_block);
      }
    EXPECT_GT(farthest, EvenBlocks::kSide) << "no block is far from all of it";
  }
}

TEST(Growths, AreUnevenInTheirWindowsOnlyAsFarAsTheKernelReaches) {
  DepthMap depth(kMapWide, kMapHigh, 0.01f);
  const FloatPlane deviation(depth.relief.size(), 3.0f);
  const PixelBounds wanted{90, 50, 110, 70};
  const std::vector<int> gaps = GapsOf(3.0);
  for (const Growth& growth :
       GrowthsOf(wanted, deviation, EvenBlocksOf(depth, {}), 0, gaps, kMapWide, kMapHigh)) {
    EXPECT_FALSE(growth.window.is_empty());
    EXPECT_TRUE(growth.uneven.is_empty());
  }
  depth.at(115, 60) = std::nanf("");  // 6 px beside what is wanted
  const auto growths =
      GrowthsOf(wanted, deviation, EvenBlocksOf(depth, {}), 0, gaps, kMapWide, kMapHigh);
  ASSERT_FALSE(growths.empty());
  EXPECT_FALSE(growths.back().uneven.is_empty());
  EXPECT_EQ(Joined(growths.back().uneven, growths.back().window), growths.back().window);
}

// The same bits, not only the same number: a part of a map then has the bytes of the whole.
TEST(PlaneMoments, OfAnEvenKernelGiveTheMean) {
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0.01f, 1e-3f);
  const MapFrame frame{1700, 900, 4096, 2047};
  FloatPlane sums(static_cast<std::size_t>(kMapWide * kMapHigh)), scratch;
  for (float& height : sums) height = noise(random);
  PlaneMoments moments(FloatPlane(sums.size(), 1.0f), sums, kMapWide, kMapHigh, frame);
  const PixelBounds whole{0, 0, kMapWide, kMapHigh};
  int reach = 0;
  for (const int gap : GapsOf(12.0)) {
    reach += gap;
    WidenOnTwoThreads(sums, kMapWide, kMapHigh, gap, {}, whole, scratch);
    WidenAll(moments.All(), kMapWide, kMapHigh, gap, {}, whole);
    ASSERT_GT(kMapHigh, 2 * reach);
    FloatPlane planes(static_cast<std::size_t>(kMapWide - 2 * reach));
    for (int y = reach; y < kMapHigh - reach; ++y) {
      moments.PlanesAt(sums, y, reach, kMapWide - reach, planes.data());
      for (std::size_t i = 0; i < planes.size(); ++i)
        ASSERT_EQ(planes[i], sums[CellAt(reach + static_cast<int>(i), y)]) << "gap " << gap;
    }
  }
}

}  // namespace
}  // namespace arthro::simulation
