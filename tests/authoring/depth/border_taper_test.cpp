#include "authoring/depth/border/border_taper.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// 80 x 60 px, of which the upper 20 rows are not imaged.
std::vector<std::uint8_t> LowerRows() {
  std::vector<std::uint8_t> imaged(80 * 60, 1);
  std::fill(imaged.begin(), imaged.begin() + 80 * 20, 0);
  return imaged;
}

DepthMap Flat(const std::vector<std::uint8_t>& imaged, float relief) {
  DepthMap depth(80, 60);
  for (std::size_t i = 0; i < imaged.size(); ++i) depth.relief[i] = imaged[i] ? relief : kUnknown;
  return depth;
}

// A bright ball that the border cuts stood out as a wall of its whole height.
TEST(BorderTaper, AnEndAtTheBorderSinksToItsSurroundings) {
  const auto imaged = LowerRows();
  DepthMap depth = Flat(imaged, 0.002f);
  for (int y = 20; y < 30; ++y)
    for (int x = 36; x < 44; ++x) depth.at(x, y) = 0.020f;
  const DepthMap before = depth;
  TaperToBorder(depth, imaged, 8);
  EXPECT_LT(depth.at(40, 20), 0.006f);
  EXPECT_NEAR(depth.at(40, 29), before.at(40, 29), 1e-6) << "beyond the band";
  for (int y = 21; y < 28; ++y) EXPECT_GE(depth.at(40, y), depth.at(40, y - 1)) << "no step";
  for (int y = 30; y < 50; ++y)
    for (int x = 10; x < 70; ++x) EXPECT_EQ(depth.at(x, y), before.at(x, y));
}

TEST(BorderTaper, FlatReliefAndWhatIsNotImagedStay) {
  const auto imaged = LowerRows();
  const DepthMap before = Flat(imaged, 0.01f);
  for (const double band : {1.0, 5.0, 1000.0}) {
    DepthMap depth = before;
    TaperToBorder(depth, imaged, band);
    for (std::size_t i = 0; i < imaged.size(); ++i)
      if (imaged[i])
        EXPECT_NEAR(depth.relief[i], 0.01f, 1e-7);
      else
        EXPECT_TRUE(std::isnan(depth.relief[i]));
  }
}

TEST(BorderTaper, NoBandNoPixelAndNothingImagedAreTaken) {
  const auto imaged = LowerRows();
  DepthMap depth = Flat(imaged, 0.01f);
  depth.at(40, 20) = 0.02f;
  for (const double band : {0.0, 0.9, std::nan("")}) {
    TaperToBorder(depth, imaged, band);
    EXPECT_EQ(depth.at(40, 20), 0.02f);
  }
  DepthMap none;
  TaperToBorder(none, {}, 4);
  DepthMap one(1, 1, 0.01f);
  TaperToBorder(one, {1}, 4);
  EXPECT_NEAR(one.at(0, 0), 0.01f, 1e-7);
  DepthMap dark(2, 2, kUnknown);
  TaperToBorder(dark, {0, 0, 0, 0}, 4);
  EXPECT_TRUE(std::isnan(dark.at(1, 1)));
}

}  // namespace
}  // namespace arthro::authoring
