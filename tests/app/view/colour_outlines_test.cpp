// Colours of a panorama beside creases of its relief, against the shapes that it was sampled from.
#include "app/view/backdrop/colour_outlines.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

constexpr int kSide = 160;
constexpr int kDark = 80, kBright = 140;

// Returns how far a place lies beyond the crease, texels: a line of the slope 0.4.
double Beyond(double x, double y) { return (0.4 * (x - 80.3) + (y - 80.2)) / std::hypot(1.0, 0.4); }

ColourImage Panorama() {
  ColourImage image(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<std::uint8_t>(Beyond(x, y) > 0 ? kBright : kDark);
  return image;
}

// A plane that bends by `crease` m per texel.
DepthMap Bent(double crease) {
  DepthMap map(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      map.at(x, y) = static_cast<float>(0.01 + crease * std::max(Beyond(x, y), 0.0));
  return map;
}

// Spread of the place, along the normal of the crease, where the colour crosses the mean of both
// sides, texels: the staircase.
double StairOf(const ColourImage& image) {
  const double u = 0.4 / std::hypot(1.0, 0.4), v = 1 / std::hypot(1.0, 0.4);
  const auto level = [&](double x, double y) {
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double f = x - i, g = y - j;
    return (1 - g) * ((1 - f) * image.at(i, j)[1] + f * image.at(i + 1, j)[1]) +
           g * ((1 - f) * image.at(i, j + 1)[1] + f * image.at(i + 1, j + 1)[1]);
  };
  double sum = 0, squares = 0;
  int count = 0;
  for (double x = 20; x < kSide - 20; x += 0.37) {
    const double y = 80.2 - 0.4 * (x - 80.3);  // on the crease
    double t = -3;
    while (t < 3 && level(x + u * t, y + v * t) < 0.5 * (kDark + kBright)) t += 0.005;
    sum += t, squares += t * t, ++count;
  }
  return std::sqrt(squares / count - sum * sum / count / count);
}

// The bounds are those of the outlines of a relief.
TEST(ColourOutlines, HaveNoStairs) {
  ColourImage smooth = Panorama();
  const double stairs = StairOf(smooth);
  SmoothColourOutlines(smooth, Bent(4e-4), false);
  const double left = StairOf(smooth);
  std::printf("colours beside a crease: %.3f texels with stairs, %.3f smoothed\n", stairs, left);
  EXPECT_LT(left, 0.1);
  EXPECT_LT(left, 0.5 * stairs);
}

TEST(ColourOutlines, ChangeNothingElsewhere) {
  const ColourImage before = Panorama();
  const auto same = [&](const DepthMap& depth, const DepthMap& sigma) {
    ColourImage after = before;
    SmoothColourOutlines(after, depth, false, sigma);
    return after.rgb == before.rgb;
  };
  EXPECT_TRUE(same({}, {})) << "no relief";
  EXPECT_TRUE(same(DepthMap(8, 8), {})) << "a relief of another size";
  EXPECT_TRUE(same(Bent(0), {})) << "a smooth relief: the colours are those of its texture";
  EXPECT_TRUE(same(DepthMap(kSide, kSide, std::numeric_limits<float>::quiet_NaN()), {}));
  EXPECT_TRUE(same(Bent(4e-4), DepthMap(kSide, kSide, 1e-4f))) << "a crease that noise explains";
  EXPECT_FALSE(same(Bent(4e-4), DepthMap(kSide, kSide, 1e-6f)));
  ColourImage after = before;
  SmoothColourOutlines(after, Bent(4e-4), false);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (after.at(x, y)[0] != before.at(x, y)[0]) {
        EXPECT_LT(std::abs(Beyond(x, y)), 4.5) << x << " " << y;
      }
  ColourImage none;
  SmoothColourOutlines(none, {}, true);
  ColourImage one(1, 1);
  SmoothColourOutlines(one, DepthMap(1, 1), true);
}

}  // namespace
}  // namespace arthro::app
