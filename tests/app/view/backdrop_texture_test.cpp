// Relief textures as they are uploaded.
#include "app/view/backdrop/backdrop_texture.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "app/view/backdrop/relief_filling.h"

namespace arthro::app {
namespace {

constexpr int kWidth = 1536, kHeight = 768;  // three texels per block of slopes

ReliefTexture ReliefOf(const DepthMap& depth, bool whole_turn = false) {
  return MakeReliefTexture({depth.width, depth.height}, depth, whole_turn);
}

// Slopes at a texel along u and along v, m per texel.
glm::dvec2 SlopeAt(const BroadSlopes& broad, int x, int y) {
  const int block = kWidth / broad.width;
  const float* at = &broad.slopes[3 * (static_cast<std::size_t>(y / block) *
                                           static_cast<std::size_t>(broad.width) +
                                       static_cast<std::size_t>(x / block))];
  return {at[0] / kWidth, at[1] / kHeight};
}

TEST(BroadSlopes, EqualTheSlopesOfAPlaneUpToTheEdge) {
  DepthMap plane(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) plane.at(x, y) = static_cast<float>(8e-6 * x + 5e-6 * y);
  const BroadSlopes broad = MakeBroadSlopes(ReliefOf(plane), false);
  EXPECT_EQ(broad.width, 512);
  EXPECT_EQ(broad.height, 256);
  for (const int x : {0, 300, kWidth - 1})
    for (const int y : {0, 300, kHeight - 1}) {
      EXPECT_NEAR(SlopeAt(broad, x, y).x, 8e-6, 1e-8) << x << " " << y;
      EXPECT_NEAR(SlopeAt(broad, x, y).y, 5e-6, 1e-8) << x << " " << y;
    }
}

// Noise of one texel: a mean has some 60 texels, and differences of neighbours cancel.
TEST(BroadSlopes, SuppressTheNoiseOfTexels) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1e-4);
  DepthMap rough(kWidth, kHeight);
  for (float& h : rough.relief) h = static_cast<float>(0.01 + noise(random));
  const ReliefTexture relief = ReliefOf(rough);
  const BroadSlopes broad = MakeBroadSlopes(relief, false);
  double before = 0, after = 0;
  int count = 0;
  for (int y = 30; y < kHeight - 30; y += 3)
    for (int x = 30; x < kWidth - 30; x += 3, ++count) {
      const double own =
          relief.texels[4 * (static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)) +
                        1] /
          kWidth;
      before += own * own;
      after += std::pow(SlopeAt(broad, x, y).x, 2);
    }
  before = std::sqrt(before / count), after = std::sqrt(after / count);
  std::printf("slopes of noise: %.2g m a texel before, %.2g after\n", before, after);
  EXPECT_NEAR(before, 1e-4 / std::sqrt(2.0), 1e-5);
  EXPECT_LT(after, before / 8);
}

// Twelve texels of further smoothing leave a third of the noise at most, and the slope of a plane.
TEST(BroadSlopes, SmoothedFurtherHaveLessNoiseAndKeepAPlane) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1e-4);
  DepthMap rough(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      rough.at(x, y) = static_cast<float>(0.01 + 8e-6 * x + noise(random));
  const ReliefTexture relief = ReliefOf(rough);
  const auto rms = [&](const BroadSlopes& broad) {
    double sum = 0, squares = 0;
    int count = 0;
    for (int y = 60; y < kHeight - 60; y += 3)
      for (int x = 60; x < kWidth - 60; x += 3, ++count) {
        const double slope = SlopeAt(broad, x, y).x;
        sum += slope, squares += slope * slope;
      }
    EXPECT_NEAR(sum / count, 8e-6, 1e-6);
    return std::sqrt(squares / count - std::pow(sum / count, 2));
  };
  EXPECT_LT(rms(MakeBroadSlopes(relief, false, 12)), rms(MakeBroadSlopes(relief, false)) / 3);
  DepthMap plane(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) plane.at(x, y) = static_cast<float>(0.01 + 8e-6 * x);
  const BroadSlopes smooth = MakeBroadSlopes(ReliefOf(plane), false, 12);
  for (int x = 0; x < kWidth; x += 5) EXPECT_NEAR(SlopeAt(smooth, x, 300).x, 8e-6, 1e-8) << x;
}

// A step of 5 mm in a plane: beside it the slope is the plane's own, on it far below the step's.
TEST(BroadSlopes, GiveAStepALowWeight) {
  DepthMap cliff(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      cliff.at(x, y) = static_cast<float>((x < 700 ? 0.01 : 0.005) + 8e-6 * x);
  const BroadSlopes broad = MakeBroadSlopes(ReliefOf(cliff), false);
  for (const int x : {600, 690, 709, 800}) EXPECT_NEAR(SlopeAt(broad, x, 300).x, 8e-6, 1e-7) << x;
  EXPECT_LT(std::abs(SlopeAt(broad, 700, 300).x), 1e-4);
  // Beside it there is no glint, else a bright line would follow each outline.
  const auto glints = [&](int x) {
    const int block = kWidth / broad.width;
    return broad
        .slopes[3 * (static_cast<std::size_t>(300 / block) * static_cast<std::size_t>(broad.width) +
                     static_cast<std::size_t>(x / block)) +
                2];
  };
  for (const int x : {699, 700}) EXPECT_EQ(glints(x), 0.0f) << x;
  for (const int x : {600, 690, 709, 800}) EXPECT_EQ(glints(x), 1.0f) << x;
}

TEST(BroadSlopes, AFullTurnHasNoSeam) {
  DepthMap wave(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      wave.at(x, y) = static_cast<float>(0.01 + 1e-3 * std::sin(2 * M_PI * x / kWidth));
  const BroadSlopes broad = MakeBroadSlopes(ReliefOf(wave, true), true);
  EXPECT_NEAR(SlopeAt(broad, 0, 300).x, SlopeAt(broad, kWidth - 1, 300).x, 1e-9);
  EXPECT_NEAR(SlopeAt(broad, 0, 300).x, 2e-3 * M_PI / kWidth, 1e-8);
}

TEST(BroadSlopes, AreZeroForOneTexelAndWithoutADepthMap) {
  EXPECT_EQ(MakeBroadSlopes(ReliefOf(DepthMap(1, 1, 0.01f)), true).slopes,
            (std::vector<float>{0, 0, 1}));
  const BroadSlopes bare = MakeBroadSlopes(MakeReliefTexture({64, 48}, {}, false), false);
  for (std::size_t i = 0; i < bare.slopes.size(); ++i)
    EXPECT_EQ(bare.slopes[i], i % 3 == 2 ? 1.0f : 0.0f);
}

// Weight of the imaged part: at a straight edge 0, inside 1 and outside -1 a band's width away, and
// 1 up to the edge of the panorama, which is no edge of what was imaged.
TEST(ReliefTexture, WeighsTheImagedPart) {
  constexpr int kEdge = kWidth / 2;
  DepthMap half(kWidth, kHeight, 0.01f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = kEdge; x < kWidth; ++x) half.at(x, y) = NAN;
  const ReliefTexture relief = ReliefOf(half);
  const auto weight = [&](int x, int y) {
    return relief
        .texels[4 * (static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)) + 3];
  };
  constexpr int kBand = static_cast<int>(kEndShare * kWidth);
  for (const int y : {0, kHeight / 2, kHeight - 1}) {
    EXPECT_EQ(weight(0, y), 1.0f) << y;
    EXPECT_EQ(weight(kEdge - kWidth / 40 - 4, y), 1.0f) << y;
    EXPECT_NEAR(weight(kEdge, y), 0.0f, 0.1) << y;
    EXPECT_NEAR(weight(kEdge + kBand / 2, y), -0.75f, 0.1) << y;
    EXPECT_NEAR(weight(kEdge + kBand + 4, y), -1.0f, 0.02) << y;
    EXPECT_NEAR(weight(kWidth - 1, y), -1.0f, 1e-5) << y;
    for (int x = kEdge - kBand; x < kEdge + kBand; ++x)
      ASSERT_LE(weight(x + 1, y), weight(x, y) + 1e-5f) << x << " " << y;
  }
}

ColourImage OneColour(int width, int height, std::uint8_t red, std::uint8_t green) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y)[0] = red, image.at(x, y)[1] = green;
  return image;
}

// Black pixels of unknown depth take the colour around them. A lighter one of unknown depth was
// imaged all the same, and a black one of known depth is a dark part of the joint: both stay.
TEST(FillUnimaged, FillsOnlyBlackPixelsOfUnknownDepth) {
  constexpr int kSide = 61;  // no power of two
  ColourImage panorama = OneColour(kSide, kSide, 200, 80);
  DepthMap depth(kSide, kSide, 0.01f);
  for (int y = 20; y < kSide; ++y)
    for (int x = 10; x < 50; ++x) {
      depth.at(x, y) = NAN;
      for (int c = 0; c < 3; ++c) panorama.at(x, y)[c] = 7;
    }
  panorama.at(30, 40)[0] = 200, panorama.at(30, 40)[1] = 90, panorama.at(30, 40)[2] = 0;
  panorama.at(5, 5)[0] = panorama.at(5, 5)[1] = 0;
  FillUnimaged(panorama, depth);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const std::uint8_t* colour = panorama.at(x, y);
      if ((x == 30 && y == 40) || (x == 5 && y == 5)) continue;
      // The dark pixel weighs a little in the largest blocks; a pixel amid the hole fills it as
      // well.
      EXPECT_NEAR(colour[0], 200, 12) << x << " " << y;
      EXPECT_GE(colour[1], 74) << x << " " << y;
      EXPECT_LE(colour[1], 90) << x << " " << y;
    }
  EXPECT_EQ(panorama.at(30, 40)[1], 90);
  EXPECT_EQ(panorama.at(5, 5)[0], 0);
}

TEST(FillUnimaged, LeavesAPanoramaWithoutItsDepthAndFillsNoneWithBlack) {
  const ColourImage dark = OneColour(9, 5, 3, 3);
  ColourImage panorama = dark;
  FillUnimaged(panorama, {});
  FillUnimaged(panorama, DepthMap(8, 5, NAN));
  EXPECT_EQ(panorama.rgb, dark.rgb);
  FillUnimaged(panorama, DepthMap(9, 5, NAN));
  EXPECT_EQ(panorama.rgb, ColourImage(9, 5).rgb);
}

// A stroke of the brush for unknown depth on imaged pixels fills nothing, so that the panorama is
// not uploaded again.
TEST(FillsOthers, ComparesBlackPixelsOnly) {
  ColourImage panorama = OneColour(16, 8, 200, 80);
  panorama.at(3, 3)[0] = panorama.at(3, 3)[1] = 0;
  const DepthMap known(16, 8, 0.01f);
  DepthMap painted = known, hole = known;
  painted.at(12, 4) = NAN;
  hole.at(3, 3) = NAN;
  EXPECT_FALSE(FillsOthers(panorama, known, painted));
  EXPECT_TRUE(FillsOthers(panorama, known, hole));
  EXPECT_TRUE(FillsOthers(panorama, {}, hole));
  EXPECT_FALSE(FillsOthers(panorama, {}, painted));
  EXPECT_FALSE(FillsOthers(panorama, hole, hole));
}

}  // namespace
}  // namespace arthro::app
