// Statistics of pictures, on pictures whose values follow by hand. Nothing is drawn.
#include "app/view/exposure/picture_statistics.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

PictureMask Whole(int width, int height) {
  return DiscMask(width, height, 0, 0, 2.0 * (width + height));
}

// Picture of a function of x and y that gives red, green and blue.
template <class Colour>
ColourImage Drawn(int width, int height, Colour colour) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto rgb = colour(x, y);
      for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(rgb[c]);
    }
  return image;
}
std::array<int, 3> Grey(int level) { return {level, level, level}; }

TEST(PictureStatistics, UniformPictureIsFlatAndHasNoSpread) {
  const auto of = MeasurePicture(Drawn(64, 48, [](int, int) { return Grey(77); }), Whole(64, 48));
  EXPECT_EQ(of.pictures, 1);
  for (const double level : {of.p1, of.p50, of.p99}) EXPECT_EQ(level, 77);
  EXPECT_EQ(of.gradient, 0);
  EXPECT_EQ(of.flat, 1);
  EXPECT_EQ(of.clipped, 0);
  EXPECT_EQ(of.black, 0);
  EXPECT_NEAR(of.chroma, 0, 1e-9);
}

// Levels 0 to 255, each on as many pixels: 6 of 256 are at most 5 and 6 at least 250, and the
// lowest level that 1 % do not exceed is the third.
TEST(PictureStatistics, RampHasItsOwnSlopeAndPercentiles) {
  const auto of =
      MeasurePicture(Drawn(256, 64, [](int x, int) { return Grey(x); }), Whole(256, 64));
  EXPECT_EQ(of.p1, 2);
  EXPECT_EQ(of.p50, 127);
  EXPECT_EQ(of.p99, 253);
  EXPECT_DOUBLE_EQ(of.clipped, 6.0 / 256);
  EXPECT_DOUBLE_EQ(of.black, 6.0 / 256);
  EXPECT_DOUBLE_EQ(of.gradient, 0.5);  // 1 along x, 0 along y
  EXPECT_EQ(of.flat, 1) << "half a grey level per px is flat";
}

TEST(PictureStatistics, SlopeAboveHalfAGreyLevelIsNotFlat) {
  const auto steep =
      MeasurePicture(Drawn(100, 100, [](int x, int y) { return Grey(x + y); }), Whole(100, 100));
  EXPECT_DOUBLE_EQ(steep.gradient, 1);
  EXPECT_EQ(steep.flat, 0);
  // A step of 40 between two halves: one column of 99 has it, along x only.
  const auto step = MeasurePicture(
      Drawn(100, 100, [](int x, int) { return Grey(x < 50 ? 60 : 100); }), Whole(100, 100));
  EXPECT_DOUBLE_EQ(step.gradient, 0.5 * 40 / 99);
  EXPECT_DOUBLE_EQ(step.flat, 98.0 / 99);
}

// The largest channel clips before the luma does.
TEST(PictureStatistics, SaturatedRedCountsAsClipped) {
  const auto of = MeasurePicture(Drawn(40, 40,
                                       [](int x, int) {
                                         return x < 10 ? std::array{250, 60, 50} : Grey(100);
                                       }),
                                 Whole(40, 40));
  EXPECT_DOUBLE_EQ(of.clipped, 0.25);
}

// Half of the pixels lie at one (Cb, Cr) and half at another: the rms is half their distance.
TEST(PictureStatistics, ChromaSpreadOfTwoColoursIsHalfTheirDistance) {
  const std::array a{200, 100, 80}, b{90, 120, 150};
  const auto of =
      MeasurePicture(Drawn(20, 20, [&](int x, int) { return x < 10 ? a : b; }), Whole(20, 20));
  const auto chroma = [](const std::array<int, 3>& c) {
    const double grey = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
    return std::array{0.564 * (c[2] - grey), 0.713 * (c[0] - grey)};
  };
  const auto ca = chroma(a), cb = chroma(b);
  EXPECT_NEAR(of.chroma, 0.5 * std::hypot(ca[0] - cb[0], ca[1] - cb[1]), 1e-9);
}

TEST(PictureStatistics, OnlyThePixelsOfTheMaskCount) {
  const PictureMask disc = DiscMask(101, 101, 50, 50, 40);
  const auto of = MeasurePicture(
      Drawn(101, 101, [](int x, int y) { return Grey(std::hypot(x - 50, y - 50) < 40 ? 120 : 0); }),
      disc);
  EXPECT_EQ(of.p1, 120);
  EXPECT_EQ(of.black, 0);
  EXPECT_EQ(of.gradient, 0) << "the edge of the disc is no gradient";
  int count = 0;
  for (const bool counts : disc.counts) count += counts ? 1 : 0;
  EXPECT_NEAR(count, std::numbers::pi * 1600, 0.02 * std::numbers::pi * 1600);
}

TEST(PictureStatistics, NothingIsMeasuredWhereNothingCounts) {
  const ColourImage picture = Drawn(30, 30, [](int x, int) { return Grey(x); });
  const auto none = MeasurePicture(picture, DiscMask(30, 30, 15, 15, 0));
  EXPECT_EQ(none.pictures, 0);
  const PictureStatistics all[] = {none, MeasurePicture(picture, Whole(30, 30)), none};
  EXPECT_EQ(MeanOf(all).pictures, 1);
  EXPECT_EQ(MeanOf(all).p50, 14);
  EXPECT_EQ(MeanOf({}).pictures, 0);
}

}  // namespace
}  // namespace arthro::app
