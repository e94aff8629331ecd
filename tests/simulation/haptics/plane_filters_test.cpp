// Filters over planes against the same sums written out, pixel by pixel.
#include "simulation/haptics/relief/plane_filters.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

constexpr int kWide = 61, kHigh = 47;

std::size_t At(int x, int y) {
  return static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x);
}

FloatPlane RandomPlane(unsigned seed, float low, float high) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(low, high);
  FloatPlane plane(static_cast<std::size_t>(kWide) * kHigh);
  for (float& value : plane) value = number(random);
  return plane;
}

// The definition: rows first, then columns.
FloatPlane Widened(const FloatPlane& data, int gap, const OuterTaps& taps) {
  const auto value = [](const FloatPlane& of, int x, int y) {
    return x < 0 || y < 0 || x >= kWide || y >= kHigh ? 0.0f : of[At(x, y)];
  };
  const auto tap = [&](const FloatPlane& of, int x, int y) {
    return of.empty() || x < 0 || y < 0 ? 0.25f : of[At(x, y)];
  };
  FloatPlane across(data.size()), both(data.size());
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x)
      across[At(x, y)] = taps.right.empty()
                             ? 0.25f * (value(data, x - gap, y) + value(data, x + gap, y)) +
                                   0.5f * value(data, x, y)
                             : tap(taps.right, x - gap, y) * value(data, x - gap, y) +
                                   tap(taps.right, x, y) * value(data, x + gap, y) +
                                   0.5f * value(data, x, y);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x)
      both[At(x, y)] = 0.5f * value(across, x, y) +
                       tap(taps.below, x, y - gap) * value(across, x, y - gap) +
                       tap(taps.below, x, y) * value(across, x, y + gap);
  return both;
}

TEST(PlaneFilters, WidenHasTheBytesOfItsDefinitionInEveryWindow) {
  const FloatPlane data = RandomPlane(1, -1.0f, 1.0f);
  const OuterTaps none, steps{RandomPlane(2, 0.0f, 0.25f), RandomPlane(3, 0.0f, 0.25f)};
  for (const OuterTaps& taps : {none, steps})
    for (const int gap : {1, 2, 8, 32, 64}) {
      const FloatPlane wanted = Widened(data, gap, taps);
      for (const PixelBounds& window :
           {PixelBounds{0, 0, kWide, kHigh}, PixelBounds{20, 11, 41, 30},
            PixelBounds{0, 40, 5, kHigh}, PixelBounds{50, 0, kWide, 9}}) {
        FloatPlane widened = data, scratch;
        Widen(widened, kWide, kHigh, gap, taps, window, scratch);
        for (int y = window.top; y < window.bottom; ++y)
          for (int x = window.left; x < window.right; ++x)
            ASSERT_EQ(widened[At(x, y)], wanted[At(x, y)])
                << x << " " << y << ", gap " << gap << ", taps " << !taps.right.empty();
      }
    }
}

TEST(PlaneFilters, DilateIsTheMaximumOfTheSquare) {
  FloatPlane data = RandomPlane(4, -1.0f, 1.0f);
  for (int i = 0; i < 40; ++i) data[At(3 * i % kWide, i)] = -std::numeric_limits<float>::infinity();
  for (const int reach : {0, 1, 3, 8, 30, 70}) {
    FloatPlane dilated = data;
    Dilate(dilated, kWide, kHigh, reach);
    for (int y = 0; y < kHigh; ++y)
      for (int x = 0; x < kWide; ++x) {
        float most = -std::numeric_limits<float>::infinity();
        for (int v = std::max(y - reach, 0); v <= std::min(y + reach, kHigh - 1); ++v)
          for (int u = std::max(x - reach, 0); u <= std::min(x + reach, kWide - 1); ++u)
            most = std::max(most, data[At(u, v)]);
        ASSERT_EQ(dilated[At(x, y)], most) << x << " " << y << ", reach " << reach;
      }
  }
}

}  // namespace
}  // namespace arthro::simulation
