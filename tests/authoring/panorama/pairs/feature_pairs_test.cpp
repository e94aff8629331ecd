// Pairs by features, on texture made in code.
#include "authoring/panorama/pairs/feature_pairs.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

using namespace arthro;
using namespace arthro::authoring;

namespace {

constexpr int kSize = 300;

// Blobs of several sizes; `seed` selects the place.
cv::Mat Ground(int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed) * 31 + 7);
  cv::Mat sum = cv::Mat::zeros(500, 500, CV_32F);
  for (const double sigma : {1.5, 3.0, 6.0}) {
    cv::Mat noise(500, 500, CV_32F);
    random.fill(noise, cv::RNG::NORMAL, 0, 1);
    cv::GaussianBlur(noise, noise, {0, 0}, sigma);
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    sum += noise / deviation[0];
  }
  return 20 * sum + 128;
}

// Working frame at half scale: the view by `ground_from_work`, with noise.
WorkingFrame See(const cv::Mat& ground, const cv::Matx33d& ground_from_work, double noise,
                 int seed) {
  cv::Mat view;
  cv::warpPerspective(ground, view, cv::Mat(ground_from_work), {kSize, kSize},
                      cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REFLECT);
  cv::Mat grain(view.size(), CV_32F);
  cv::RNG(static_cast<std::uint64_t>(seed) + 99).fill(grain, cv::RNG::NORMAL, 0, noise);
  view += grain;
  WorkingFrame frame;
  frame.scale = 0.5;
  view.convertTo(frame.grey, CV_8U);
  frame.mask = cv::Mat::zeros(kSize, kSize, CV_8U);
  cv::circle(frame.mask, {kSize / 2, kSize / 2}, kSize / 2 - 4, 255, -1);
  frame.noise = noise;
  frame.texture = 34;
  return frame;
}

// inverse of x_rect = (x_work + 0.5) / 0.5 - 0.5
const cv::Matx33d kRectFromWork(2, 0, 0.5, 0, 2, 0.5, 0, 0, 1);
const cv::Matx33d kGroundFromA(1, 0, 90, 0, 1, 100, 0, 0, 1);
const cv::Matx33d kGroundFromB(0.99, -0.1, 130, 0.1, 0.99, 85, 5e-5, -4e-5, 1);

cv::Matx33d Truth() {
  return kRectFromWork * kGroundFromB.inv() * kGroundFromA * kRectFromWork.inv();
}

}  // namespace

class EveryDetector : public testing::TestWithParam<Detector> {};

TEST_P(EveryDetector, PutsAPairTogetherToAPixel) {
  FeatureOptions options;
  options.detector = GetParam();
  const cv::Mat ground = Ground(1);
  const FrameFeatures a = DetectFeatures(See(ground, kGroundFromA, 4, 1), options);
  const FrameFeatures b = DetectFeatures(See(ground, kGroundFromB, 4, 2), options);
  EXPECT_GT(a.points().size(), 150u);
  std::string why_not;
  const auto pair = MatchFeatures(a, b, 0, 1, options, &why_not);
  ASSERT_TRUE(pair) << why_not;
  // A detector at half scale has an accuracy of 0.3 … 1 px per point; 50 and more of them average
  // that.
  for (const auto& p : pair->control_in_a)
    EXPECT_LT(cv::norm(Apply(pair->b_from_a, p) - Apply(Truth(), p)), 1.0);
  EXPECT_GE(pair->inliers, 30);
}

TEST_P(EveryDetector, RefusesAnotherPlaceAndNothing) {
  FeatureOptions options;
  options.detector = GetParam();
  const FrameFeatures here = DetectFeatures(See(Ground(1), kGroundFromA, 4, 1), options);
  const FrameFeatures there = DetectFeatures(See(Ground(2), kGroundFromA, 4, 2), options);
  std::string why_not;
  EXPECT_FALSE(MatchFeatures(here, there, 0, 1, options, &why_not));
  EXPECT_FALSE(why_not.empty());
  WorkingFrame blank = See(Ground(1), kGroundFromA, 0, 1);
  blank.grey.setTo(128);
  blank.texture = 0;
  const FrameFeatures nothing = DetectFeatures(blank, options);
  EXPECT_TRUE(nothing.points().empty());
  EXPECT_FALSE(MatchFeatures(here, nothing, 0, 1, options, &why_not));
  WorkingFrame tiny;
  tiny.grey = cv::Mat(1, 1, CV_8U, cv::Scalar(128));
  tiny.mask = cv::Mat(1, 1, CV_8U, cv::Scalar(255));
  tiny.texture = 10;
  EXPECT_TRUE(DetectFeatures(tiny, options).points().empty());
}

TEST_P(EveryDetector, GivesTheSameAtAnyThreadCountAndHistory) {
  FeatureOptions options;
  options.detector = GetParam();
  const WorkingFrame frame_a = See(Ground(1), kGroundFromA, 4, 1);
  const WorkingFrame frame_b = See(Ground(1), kGroundFromB, 4, 2);
  const auto run = [&](int threads) {
    cv::setNumThreads(threads);
    const auto pair = MatchFeatures(DetectFeatures(frame_a, options),
                                    DetectFeatures(frame_b, options), 0, 1, options, nullptr);
    cv::setNumThreads(-1);
    return pair.value();
  };
  const PairEstimate one = run(1);
  cv::theRNG() = cv::RNG(12345);  // other code has drawn numbers meanwhile
  const PairEstimate two = run(2);
  EXPECT_EQ(cv::norm(one.b_from_a - two.b_from_a), 0);
  EXPECT_EQ(cv::norm(one.information - two.information), 0);
}

std::string NameOf(const testing::TestParamInfo<Detector>& detector) {
  const char* names[] = {"Surf", "Sift", "Akaze", "Orb"};
  return names[static_cast<int>(detector.param)];
}

INSTANTIATE_TEST_SUITE_P(Features, EveryDetector,
                         testing::Values(Detector::kSurf, Detector::kSift, Detector::kAkaze,
                                         Detector::kOrb),
                         NameOf);

TEST(FeaturePairs, InformationSaysHowFarOffItIs) {
  // Mean of d^T Λ d of the eight control displacements: 8 for an honest information. Detectors'
  // errors are not quite normal, so half to twice as much is accepted.
  const cv::Mat ground = Ground(1);
  double sum = 0;
  constexpr int kTrials = 12;
  for (int trial = 0; trial < kTrials; ++trial) {
    const FrameFeatures a = DetectFeatures(See(ground, kGroundFromA, 6, 100 + trial), {});
    const FrameFeatures b = DetectFeatures(See(ground, kGroundFromB, 6, 200 + trial), {});
    const auto pair = MatchFeatures(a, b, 0, 1, {}, nullptr);
    ASSERT_TRUE(pair);
    cv::Matx<double, 8, 1> d;
    for (int k = 0; k < 4; ++k) {
      const auto& p = pair->control_in_a[static_cast<std::size_t>(k)];
      const cv::Point2d e = Apply(pair->b_from_a, p) - Apply(Truth(), p);
      d(2 * k) = e.x;
      d(2 * k + 1) = e.y;
    }
    sum += (d.t() * pair->information * d)(0);
  }
  const double mean = sum / kTrials;
  RecordProperty("mean_normalised_error", std::to_string(mean));
  EXPECT_GT(mean, 2.0);
  EXPECT_LT(mean, 16.0);
}
