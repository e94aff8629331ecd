// Direct alignment on faint scenes with exact homographies.
#include "authoring/panorama/pairs/direct_align.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "authoring/panorama/pairs/direct_solver.h"
#include "authoring/panorama/pairs/verify_pair.h"
#include "simulation/core/error.h"
#include "tests/authoring/panorama/pairs/faint_scene.h"

namespace arthro::authoring {
namespace {

using test::FaintLook;
using test::FaintScene;

// The worst of nine points of frame a: its middle and eight at 60 % of its radius.
double WorstError(const cv::Matx33d& estimate, const cv::Matx33d& truth) {
  const double m = 0.5 * (FaintScene::kSide - 1), r = 0.6 * m;
  double worst = cv::norm(Apply(estimate, {m, m}) - Apply(truth, {m, m}));
  for (int i = 0; i < 8; ++i) {
    const cv::Point2d p(m + r * std::cos(i * CV_PI / 4), m + r * std::sin(i * CV_PI / 4));
    worst = std::max(worst, cv::norm(Apply(estimate, p) - Apply(truth, p)));
  }
  return worst;
}

struct Pair {
  WorkingFrame a, b;
  cv::Matx33d b_from_a;
};

// A step of a quarter of the frame with rotation, zoom and tilt.
Pair Neighbours(FaintLook look, std::uint64_t seed = 1) {
  static const FaintScene scene;
  const cv::Matx33d pa = FaintScene::Pose(-30, 10),
                    pb = FaintScene::Pose(60, 50, 0.11, 1.06, {1e-4, -8e-5});
  look.seed = 2 * seed;
  Pair pair;
  pair.a = scene.Frame(pa, look);
  look.seed = 2 * seed + 1;
  pair.b = scene.Frame(pb, look);
  pair.b_from_a = pb.inv() * pa;
  return pair;
}

std::optional<PairEstimate> Found(const Pair& pair, std::string* why = nullptr) {
  const DirectOptions options;
  const DirectPyramid a(pair.a, options), b(pair.b, options);
  const auto start = CoarseAlign(a, b, nullptr, options);
  if (!start) {
    if (why) *why = "no start";
    return std::nullopt;
  }
  return AlignDirect(a, b, 0, 1, *start, options, why);
}

TEST(DirectAlign, FindsFaintTextureUnderEqualNoiseToSubPixel) {
  const Pair pair = Neighbours({});
  std::string why;
  const auto estimate = Found(pair, &why);
  ASSERT_TRUE(estimate) << why;
  // Pixel noise as large as the texture: three times the expected error of such a pair.
  EXPECT_LT(WorstError(estimate->b_from_a, pair.b_from_a), 0.6);
  EXPECT_GT(estimate->similarity, 0.3);
  EXPECT_GT(estimate->overlap, 0.5);
}

TEST(DirectAlign, IsFineToAFractionOfAPixelWithoutNoise) {
  FaintLook look;
  look.noise = 0;
  look.texture = 20;
  const Pair pair = Neighbours(look);
  const auto estimate = Found(pair);
  ASSERT_TRUE(estimate);
  EXPECT_LT(WorstError(estimate->b_from_a, pair.b_from_a), 0.1);
}

TEST(DirectAlign, GainBetweenTheFramesMovesNothing) {
  FaintLook look;
  look.noise = 1;
  Pair pair = Neighbours(look);
  const auto plain = Found(pair);
  pair.b.grey.convertTo(pair.b.grey, CV_8UC1, 2.5, 128 - 2.5 * 128);
  const auto bright = Found(pair);
  ASSERT_TRUE(plain && bright);
  EXPECT_LT(WorstError(bright->b_from_a, plain->b_from_a), 0.1);
}

TEST(DirectAlign, DebrisDropsOut) {
  FaintLook look;
  look.noise = 3;
  look.blobs = 10;  // a twentieth of each frame
  const Pair pair = Neighbours(look);
  std::string why;
  const auto estimate = Found(pair, &why);
  ASSERT_TRUE(estimate) << why;
  EXPECT_LT(WorstError(estimate->b_from_a, pair.b_from_a), 1.0);
}

TEST(DirectAlign, TheSameFrameTwiceIsTheIdentity) {
  Pair pair = Neighbours({});
  pair.b = pair.a;
  const auto estimate = Found(pair);
  ASSERT_TRUE(estimate);
  EXPECT_LT(WorstError(estimate->b_from_a, cv::Matx33d::eye()), 0.1);
}

TEST(DirectAlign, ARepeatedLookWithNewNoiseIsTheIdentity) {
  const FaintScene scene;
  FaintLook look;
  look.noise = 2;
  Pair pair;
  pair.a = scene.Frame(FaintScene::Pose(0, 0), look);
  look.seed = 99;
  pair.b = scene.Frame(FaintScene::Pose(0, 0), look);
  const auto estimate = Found(pair);
  ASSERT_TRUE(estimate);
  EXPECT_LT(WorstError(estimate->b_from_a, cv::Matx33d::eye()), 0.1);
}

TEST(DirectAlign, RefusesFramesOfDifferentPlaces) {
  const FaintScene here(1), there(2);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    FaintLook look;
    look.seed = seed;
    Pair pair;
    pair.a = here.Frame(FaintScene::Pose(0, 0), look);
    look.seed = 100 + seed;
    pair.b = there.Frame(FaintScene::Pose(10.0 * static_cast<double>(seed), 0), look);
    std::string why;
    EXPECT_FALSE(Found(pair, &why));
    EXPECT_FALSE(why.empty());
  }
}

TEST(DirectAlign, RefusesFlatAndEmptyFrames) {
  Pair pair = Neighbours({});
  const WorkingFrame textured = pair.b;
  pair.b.grey.setTo(128);
  std::string why;
  EXPECT_FALSE(Found(pair, &why));
  pair.b = textured;
  pair.b.mask.setTo(0);
  EXPECT_FALSE(Found(pair, &why));
  const DirectOptions options;
  EXPECT_FALSE(AlignDirect(DirectPyramid(pair.a), DirectPyramid(pair.b), 0, 1, cv::Matx33d::eye(),
                           options, &why));
  EXPECT_EQ(why, "no texture to compare");
}

TEST(DirectAlign, RefusesAStartThatIsNoHomography) {
  const Pair pair = Neighbours({});
  const DirectOptions options;
  const DirectPyramid a(pair.a), b(pair.b);
  std::string why;
  EXPECT_FALSE(AlignDirect(a, b, 0, 1, cv::Matx33d::zeros(), options, &why));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(AlignDirect(a, b, 0, 1, cv::Matx33d::eye() * nan, options, &why));
  EXPECT_FALSE(AlignDirect(a, b, 0, 1, {1, 0, 5000, 0, 1, 0, 0, 0, 1}, options, &why));
  EXPECT_FALSE(why.empty());
}

TEST(DirectAlign, RefusesPicturesThatAreNoWorkingFrames) {
  WorkingFrame frame;
  EXPECT_THROW(DirectPyramid{frame}, Error);
  frame.grey = cv::Mat::zeros(40, 40, CV_8UC3);
  frame.mask = cv::Mat::zeros(40, 40, CV_8UC1);
  EXPECT_THROW(DirectPyramid{frame}, Error);
  for (const int side : {1, 2, 7}) {
    frame.grey = cv::Mat(side, side, CV_8UC1, cv::Scalar(128));
    frame.mask = cv::Mat(side, side, CV_8UC1, cv::Scalar(255));
    EXPECT_FALSE(DirectPyramid(frame).HasTexture());
  }
}

TEST(DirectAlign, APredictionThatIsOffIsCorrected) {
  const Pair pair = Neighbours({});
  const DirectOptions options;
  const DirectPyramid a(pair.a), b(pair.b);
  const double m = 0.5 * FaintScene::kSide, angle = 0.05, c = std::cos(angle), s = std::sin(angle);
  const cv::Matx33d off(c, -s, m - c * m + s * m + 30, s, c, m - s * m - c * m - 25, 0, 0, 1);
  const cv::Matx33d predicted = off * pair.b_from_a;
  const auto start = CoarseAlign(a, b, &predicted, options);
  ASSERT_TRUE(start);
  const auto estimate = AlignDirect(a, b, 3, 4, *start, options, nullptr);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->a, 3);
  EXPECT_EQ(estimate->b, 4);
  EXPECT_LT(WorstError(estimate->b_from_a, pair.b_from_a), 0.6);
}

TEST(DirectAlign, SameInputSameBytes) {
  const Pair pair = Neighbours({});
  const auto first = Found(pair), again = Found(pair);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->b_from_a, again->b_from_a);
  EXPECT_EQ(first->information, again->information);
}

TEST(DirectAlign, InformationIsTheInverseCovarianceOfTheError) {
  // Mean of d' Λ d over 8 degrees of freedom and 16 noises: 8 ± 1 by chance (sqrt(16 / 16)). The
  // band allows for a covariance that is wrong by a factor of 1.5 either way.
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Pair pair = Neighbours({}, seed);
    const DirectOptions options;
    const DirectPyramid a(pair.a), b(pair.b);
    const auto estimate = AlignDirect(a, b, 0, 1, pair.b_from_a, options, nullptr);
    ASSERT_TRUE(estimate);
    Mat8 information = estimate->information;
    cv::Matx<double, 8, 1> d;
    for (int i = 0; i < 4; ++i) {
      const cv::Point2d off = Apply(pair.b_from_a, estimate->control_in_a[i]) -
                              Apply(estimate->b_from_a, estimate->control_in_a[i]);
      d(2 * i) = off.x, d(2 * i + 1) = off.y;
    }
    sum += (d.t() * information * d)(0);
    ++count;
  }
  EXPECT_GT(sum / count, 5.3);
  EXPECT_LT(sum / count, 12.0);
}

}  // namespace
}  // namespace arthro::authoring
