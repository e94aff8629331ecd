#include "authoring/depth/depth_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "simulation/core/error.h"
#include "simulation/core/options_json.h"
#include "simulation/scene/image_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

constexpr float kNear = 0.02f, kFar = 0.003f;

// The filter alone: no median, no highlights, the full range of greys.
DepthOptions Plain(DepthLaw law = DepthLaw::kLinear) {
  DepthOptions options;
  options.law = law;
  options.near_relief = kNear;
  options.far_relief = kFar;
  options.low_percentile = 0;
  options.high_percentile = 100;
  options.median_radius = 0;
  options.border_margin = 0;
  options.border_taper = options.step_width = 0;
  options.surround_threshold = 0;
  options.fill_highlights = false;
  return options;
}

void Put(ColourImage& image, int x, int y, int r, int g, int b) {
  image.at(x, y)[0] = static_cast<std::uint8_t>(r);
  image.at(x, y)[1] = static_cast<std::uint8_t>(g);
  image.at(x, y)[2] = static_cast<std::uint8_t>(b);
}

ColourImage Uniform(int width, int height, int r, int g, int b) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) Put(image, x, y, r, g, b);
  return image;
}

bool SameBytes(const DepthMap& a, const DepthMap& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) == 0;
}

TEST(DepthFilter, BrighterIsNeverFurtherUnderBothLaws) {
  ColourImage ramp(256, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 256; ++x) Put(ramp, x, y, x, x, x);
  for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare}) {
    const DepthMap depth = DepthFromColour(ramp, Plain(law));
    for (int x = 1; x < 256; ++x) EXPECT_GE(depth.at(x, 1), depth.at(x - 1, 1)) << x;
    for (int x = 3; x < 256; ++x) EXPECT_GT(depth.at(x, 1), depth.at(x - 1, 1)) << x;
    EXPECT_EQ(depth.at(0, 1), kFar);
    EXPECT_EQ(depth.at(255, 1), kNear);
  }
}

TEST(DepthFilter, LawsFollowTheirFormulas) {
  ColourImage ramp(256, 1);
  for (int x = 0; x < 256; ++x) Put(ramp, x, 0, std::max(x, 16), std::max(x, 16), std::max(x, 16));
  DepthOptions options = Plain(DepthLaw::kInverseSquare);
  options.gamma = 1.0;
  const DepthMap linear = DepthFromColour(ramp, Plain()), square = DepthFromColour(ramp, options);
  // Distance 1/sqrt(I), from I = 16/255 (furthest) to 1 (nearest).
  const double furthest = 1 / std::sqrt(16 / 255.0);
  for (int x = 16; x < 256; ++x) {
    const double share = (x - 16) / 239.0;
    const double nearness = (furthest - 1 / std::sqrt(x / 255.0)) / (furthest - 1.0);
    // Floats hold 20 mm to 1e-9 m.
    EXPECT_NEAR(linear.at(x, 0), kFar + share * (kNear - kFar), 2e-9);
    EXPECT_NEAR(square.at(x, 0), kFar + nearness * (kNear - kFar), 2e-9);
  }
}

TEST(DepthFilter, RangeIsExactlyFarToNearOverWhatWasImaged) {
  const ColourImage knee = test::KneePicture(160, 120);
  for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare})
    for (const int radius : {0, 1, 2, 4}) {
      DepthOptions options;
      options.law = law;
      options.median_radius = radius;
      options.near_relief = kNear;
      options.far_relief = kFar;
      const DepthMap depth = DepthFromColour(knee, options);
      float least = INFINITY, most = -INFINITY;
      for (const float h : depth.relief)
        if (!std::isnan(h)) {
          least = std::min(least, h);
          most = std::max(most, h);
        }
      EXPECT_EQ(least, kFar);
      EXPECT_EQ(most, kNear);
    }
}

TEST(DepthFilter, RedTissueOfTheSameBrightnessIsNotNearer) {
  // Muscle with as much green and blue as bone, and more red, must not come nearer than bone with
  // more of all three; with equal weights it would.
  ColourImage image = Uniform(30, 10, 60, 60, 60);
  for (int y = 0; y < 10; ++y) {
    for (int x = 10; x < 20; ++x) Put(image, x, y, 250, 60, 60);    // muscle
    for (int x = 20; x < 30; ++x) Put(image, x, y, 110, 110, 110);  // bone
  }
  DepthOptions even = Plain();
  even.red_weight = even.green_weight = even.blue_weight = 1.0 / 3;
  EXPECT_GT(DepthFromColour(image, even).at(15, 5), DepthFromColour(image, even).at(25, 5));
  EXPECT_LT(DepthFromColour(image, Plain()).at(15, 5), DepthFromColour(image, Plain()).at(25, 5));
  DepthOptions no_red = Plain();
  no_red.red_weight = 0;
  EXPECT_EQ(DepthFromColour(image, no_red).at(15, 5), DepthFromColour(image, no_red).at(5, 5));
}

TEST(DepthFilter, OnlyTheRatioOfTheWeightsCounts) {
  const ColourImage knee = test::KneePicture(64, 64);
  DepthOptions halved;
  halved.red_weight /= 2;
  halved.green_weight /= 2;
  halved.blue_weight /= 2;
  EXPECT_TRUE(SameBytes(DepthFromColour(knee, DepthOptions{}), DepthFromColour(knee, halved)));
}

TEST(DepthFilter, SurroundAndRimAreNaNAndTissueIsNot) {
  constexpr int kSize = 200;
  const ColourImage knee = test::KneePicture(kSize, kSize, 0.0);
  DepthOptions options;
  options.border_margin = 4;
  DepthReport report;
  const DepthMap depth = DepthFromColour(knee, options, &report);
  int imaged = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      // The picture's circle has a radius of sqrt(0.96) of half its size.
      const double r = std::hypot(x - 99.5, y - 99.5), rim = std::sqrt(0.96) * 100;
      imaged += !std::isnan(depth.at(x, y));
      // A chessboard distance of 4 px is at most 4 sqrt(2) px, and a pixel of rounding.
      if (r < rim - 4 * std::sqrt(2.0) - 1) {
        EXPECT_FALSE(std::isnan(depth.at(x, y))) << x << " " << y;
      } else if (r > rim - 3) {
        EXPECT_TRUE(std::isnan(depth.at(x, y))) << x << " " << y;
      }
    }
  EXPECT_NEAR(report.imaged_share, imaged / double(kSize * kSize), 1e-12);
}

TEST(DepthFilter, APictureToTheEdgeIsImagedToTheEdge) {
  const DepthMap depth = DepthFromColour(Uniform(20, 20, 90, 80, 70), DepthOptions{});
  for (const float h : depth.relief) EXPECT_FALSE(std::isnan(h));
}

TEST(DepthFilter, MedianTakesAwaySaltAndPepperAndKeepsAnEdge) {
  ColourImage clean(80, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const int grey = x < 40 ? 80 : 160;
      Put(clean, x, y, grey, grey, grey);
    }
  ColourImage noisy = clean;
  std::uint32_t random = 7;
  for (int i = 0; i < 80 * 60 / 20; ++i) {
    random = random * 1664525u + 1013904223u;
    const int at = static_cast<int>((random >> 8) % (80 * 60)), grey = i % 2 ? 240 : 20;
    Put(noisy, at % 80, at / 80, grey, grey, grey);
  }
  DepthOptions options = Plain();
  options.median_radius = 2;
  EXPECT_FALSE(SameBytes(DepthFromColour(noisy, Plain()), DepthFromColour(clean, Plain())));
  EXPECT_TRUE(SameBytes(DepthFromColour(noisy, options), DepthFromColour(clean, options)));
}

TEST(DepthFilter, AGlintIsFilledFromAroundItAndIsNoPeak) {
  ColourImage image(120, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) Put(image, x, y, 60 + x, 60 + x, 60 + x);
  DepthOptions options = Plain();
  const DepthMap clean = DepthFromColour(image, options);
  for (int y = 40; y < 47; ++y)
    for (int x = 50; x < 58; ++x) Put(image, x, y, 255, 255, 255);
  EXPECT_EQ(DepthFromColour(image, options).at(53, 43), kNear) << "without filling it is a peak";
  options.fill_highlights = true;
  DepthReport report;
  const DepthMap filled = DepthFromColour(image, options, &report);
  // 8 x 7 pixels plus 1 pixel of glow around them.
  EXPECT_NEAR(report.highlight_share, 10.0 * 9.0 / (120 * 90), 1e-12);
  double worst = 0;
  for (std::size_t i = 0; i < clean.relief.size(); ++i)
    worst = std::max(worst, std::abs(double(filled.relief[i]) - clean.relief[i]));
  const double slope = (kNear - kFar) / 119;
  std::printf("glint filled to within %.2f mm, %.1f px of the slope\n", 1e3 * worst, worst / slope);
  // The error is at most the relief of this slope over the width of the highlight and its glow.
  EXPECT_LT(worst, 10 * slope);
}

// Most highlights of real footage are not saturated.
TEST(DepthFilter, AGlintIsSmallPaleAndStandsOut) {
  constexpr int kSize = 400;  // so that a highlight is up to 10 px across
  const auto is_kept = [&](int size, int r, int g, int b) {
    ColourImage image = Uniform(kSize, kSize, 120, 50, 45);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        Put(image, x, y, 20, 15, 15);  // the ends of the range, too large for highlights
        Put(image, kSize - 1 - x, y, 240, 235, 230);
      }
    for (int y = 200; y < 200 + size; ++y)
      for (int x = 200; x < 200 + size; ++x) Put(image, x, y, r, g, b);
    DepthOptions options = Plain();
    const int middle = 200 + size / 2;
    const float as_it_is = DepthFromColour(image, options).at(middle, middle);
    options.fill_highlights = true;
    return DepthFromColour(image, options).at(middle, middle) == as_it_is;
  };
  EXPECT_FALSE(is_kept(6, 220, 200, 210)) << "a pale spot is a glint";
  EXPECT_TRUE(is_kept(6, 250, 120, 110)) << "a spot of tissue's colour is tissue";
  EXPECT_TRUE(is_kept(6, 120, 80, 75)) << "a pale spot that hardly stands out is tissue";
  EXPECT_TRUE(is_kept(60, 220, 200, 210)) << "a large pale thing is bone";
}

TEST(DepthFilter, AnOverexposedPictureIsLeftAsItIsAndSaidSo) {
  ColourImage image = Uniform(40, 40, 255, 255, 255);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) Put(image, x, y, 100, 100, 100);
  DepthReport report;
  const DepthMap depth = DepthFromColour(image, DepthOptions{}, &report);
  EXPECT_TRUE(report.is_overexposed);
  EXPECT_GT(depth.at(20, 35), depth.at(20, 5));
}

TEST(DepthFilter, AFlatPictureLiesAtTheFarReliefAndIsSaidToBeFlat) {
  for (const int grey : {1, 100, 255})
    for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare}) {
      DepthReport report;
      const DepthMap depth =
          DepthFromColour(Uniform(33, 17, grey, grey, grey), Plain(law), &report);
      EXPECT_TRUE(report.is_flat);
      for (const float h : depth.relief) EXPECT_EQ(h, kFar);
    }
}

TEST(DepthFilter, OneDeviatingPixelInAFlatPictureStillSpansTheRange) {
  ColourImage image = Uniform(50, 50, 100, 100, 100);
  Put(image, 20, 20, 140, 140, 140);
  DepthOptions options = Plain();
  options.low_percentile = 1;
  options.high_percentile = 99;
  DepthReport report;
  const DepthMap depth = DepthFromColour(image, options, &report);
  EXPECT_FALSE(report.is_flat);
  EXPECT_EQ(depth.at(20, 20), kNear);
  EXPECT_EQ(depth.at(0, 0), kFar);
}

TEST(DepthFilter, TinyBlackAndEmptyPicturesAreNoTrouble) {
  DepthReport report;
  const DepthMap one = DepthFromColour(Uniform(1, 1, 120, 90, 90), DepthOptions{}, &report);
  EXPECT_EQ(one.at(0, 0), 0.0f);
  EXPECT_TRUE(report.is_flat);
  const DepthMap black = DepthFromColour(ColourImage(37, 23), DepthOptions{}, &report);
  EXPECT_EQ(report.imaged_share, 0.0);
  EXPECT_FALSE(report.is_flat);
  for (const float h : black.relief) EXPECT_TRUE(std::isnan(h));
  EXPECT_TRUE(DepthFromColour(ColourImage{}, DepthOptions{}).empty());
  // Narrower than the median's window, in every direction.
  DepthOptions wide;
  wide.median_radius = 15;
  for (const auto& [w, h] : {std::pair{1, 40}, std::pair{40, 1}, std::pair{3, 2}})
    for (const float value : DepthFromColour(Uniform(w, h, 80, 80, 80), wide).relief)
      EXPECT_EQ(value, 0.0f);
}

TEST(DepthFilter, GreyTransparentAndDeepFilesGiveTheSame) {
  test::TempFolder folder;
  cv::Mat grey(40, 60, CV_8U), clear(40, 60, CV_8UC4), deep(40, 60, CV_16U);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const auto value = static_cast<std::uint8_t>(40 + 2 * x + y);
      grey.at<std::uint8_t>(y, x) = value;
      clear.at<cv::Vec4b>(y, x) = {value, value, value, 128};
      deep.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(257 * value);
    }
  cv::imwrite((folder / "grey.png").string(), grey);
  cv::imwrite((folder / "clear.png").string(), clear);
  cv::imwrite((folder / "deep.png").string(), deep);
  const DepthMap depth = DepthFromColour(ReadColourImage(folder / "grey.png"), {});
  EXPECT_GT(depth.at(59, 39), depth.at(0, 0));
  for (const char* name : {"clear.png", "deep.png"})
    EXPECT_TRUE(SameBytes(DepthFromColour(ReadColourImage(folder / name), {}), depth)) << name;
}

TEST(DepthFilter, IsTheSameAtEveryNumberOfThreads) {
  const ColourImage knee = test::KneePicture(700, 333);
  const int threads = cv::getNumThreads();
  for (const int radius : {2, 5}) {
    DepthOptions options;
    options.median_radius = radius;
    cv::setNumThreads(1);
    const DepthMap alone = DepthFromColour(knee, options);
    for (const int count : {2, 3, 8}) {
      cv::setNumThreads(count);
      EXPECT_TRUE(SameBytes(DepthFromColour(knee, options), alone)) << count << " threads";
    }
  }
  cv::setNumThreads(threads);
}

TEST(DepthFilter, RefusesOptionsThatContradictEachOther) {
  const ColourImage image = Uniform(4, 4, 50, 50, 50);
  DepthOptions weights, percentiles, reliefs, range;
  weights.red_weight = weights.green_weight = weights.blue_weight = 0;
  percentiles.low_percentile = percentiles.high_percentile = 50;
  reliefs.near_relief = 0.001;
  reliefs.far_relief = 0.002;
  range.median_radius = 99;
  for (const DepthOptions& options : {weights, percentiles, reliefs, range})
    EXPECT_THROW(DepthFromColour(image, options), Error);
  DepthOptions not_a_number;
  not_a_number.near_relief = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(DepthFromColour(image, not_a_number), Error);
}

TEST(DepthFilter, StopsWhenAsked) {
  std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  EXPECT_THROW(DepthFromColour(Uniform(9, 9, 9, 9, 9), DepthOptions{}, nullptr, progress), Error);
}

TEST(DepthOptions, SurviveJson) {
  DepthOptions options;
  options.law = DepthLaw::kInverseSquare;
  options.near_relief = 0.0123;
  options.median_radius = 7;
  options.fill_highlights = false;
  const DepthOptions back = OptionsFromJson<DepthOptions>(JsonFromOptions(options));
  EXPECT_EQ(JsonFromOptions(back), JsonFromOptions(options));
  EXPECT_EQ(JsonFromOptions(options)["law"], "inverse-square");
}

}  // namespace
}  // namespace arthro::authoring
