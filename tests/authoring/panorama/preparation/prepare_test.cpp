// The picture for matching: no light, no exposure, no amplified noise.
#include "authoring/panorama/preparation/prepare.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "simulation/core/error.h"
#include "tests/authoring/panorama/preparation/synthetic_frames.h"

using namespace arthro;
using namespace arthro::authoring;

namespace {

constexpr int kSize = 220;

// Root mean square difference of two greys where both frames are valid.
double DifferenceOf(const WorkingFrame& a, const WorkingFrame& b) {
  const cv::Mat both = a.mask & b.mask;
  return cv::norm(a.grey, b.grey, cv::NORM_L2, both) / std::sqrt(cv::countNonZero(both));
}

double DeviationOf(const WorkingFrame& frame) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(frame.grey, mean, deviation, frame.mask);
  return deviation[0];
}

WorkingFrame PrepareAlone(const test::FrameLook& look, const PrepareOptions& options = {}) {
  return Prepare(0, test::MakeFrame(kSize, look), 0.5, test::RoundWindow(kSize), ClipLook{},
                 options);
}

}  // namespace

TEST(Preparation, FlatTissueUnderStrongFalloffIsFlatUpToTheRim) {
  // The light at the rim is a fifth of the centre's. Full gain without noise amplifies the rounding
  // to 8 bits: without texture the gain is at most_noise / noise.
  test::FrameLook look;
  look.texture = 0;
  look.falloff = 1.6;
  const WorkingFrame frame = PrepareAlone(look);
  const double radius = kSize / 2.0;
  double rim = 0, centre = 0;
  int rim_count = 0, centre_count = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      if (!frame.mask.at<std::uint8_t>(y, x)) continue;
      const bool is_rim = std::hypot(x - radius, y - radius) > 0.85 * radius;
      (is_rim ? rim : centre) += frame.grey.at<std::uint8_t>(y, x);
      ++(is_rim ? rim_count : centre_count);
    }
  ASSERT_GT(rim_count, 1000);
  EXPECT_NEAR(rim / rim_count, 128, 2.0);
  EXPECT_NEAR(centre / centre_count, 128, 2.0);
}

TEST(Preparation, ExposureAndGammaDoNotShow) {
  // PAN-17: a step of 4 in exposure, gamma 1.6 to 2.4. The same texture must come out, up to
  // rounding in the darker frame. Without preparation, the means alone differ by 60 grey levels.
  test::FrameLook bright;
  bright.exposure = 0.8;
  const WorkingFrame reference = PrepareAlone(bright);
  test::FrameLook dark = bright;
  dark.exposure = 0.2;
  EXPECT_LT(DifferenceOf(reference, PrepareAlone(dark)), 4.0);
  test::FrameLook flat = bright;
  flat.gamma = 1.6;
  EXPECT_LT(DifferenceOf(reference, PrepareAlone(flat)), 4.0);
  EXPECT_GT(DeviationOf(reference), 25.0);
}

TEST(Preparation, PureNoiseIsNotRaisedToTexture) {
  test::FrameLook look;
  look.texture = 0;
  look.noise = 4;
  const PrepareOptions options;
  const WorkingFrame frame = PrepareAlone(look, options);
  // The noise estimate may be a third off; texture would have been raised to `contrast`, 36.
  EXPECT_LT(DeviationOf(frame), 1.33 * options.most_noise);
  EXPECT_LT(frame.texture, 0.75 * DeviationOf(frame));
}

TEST(Preparation, BadInputIsRefusedInASentence) {
  const cv::Mat rgb = test::MakeFrame(64, {}), mask = test::RoundWindow(64);
  EXPECT_THROW(Prepare(0, cv::Mat(), 0.5, mask, {}, {}), Error);
  EXPECT_THROW(Prepare(0, rgb, 0.5, test::RoundWindow(60), {}, {}), Error);
  EXPECT_THROW(Prepare(0, rgb, 0.0, mask, {}, {}), Error);
  EXPECT_THROW(Prepare(0, rgb, std::nan(""), mask, {}, {}), Error);
  ClipLookBuilder builder;
  builder.Add(rgb, mask);
  EXPECT_THROW(builder.Add(test::MakeFrame(60, {}), test::RoundWindow(60)), Error);
}

TEST(Preparation, AFrameWithNothingInItIsEmptyNotAnError) {
  const WorkingFrame black =
      Prepare(3, cv::Mat::zeros(64, 64, CV_8UC3), 0.5, cv::Mat::zeros(64, 64, CV_8U), {}, {});
  EXPECT_EQ(cv::countNonZero(black.mask), 0);
  EXPECT_EQ(black.index, 3);
  const WorkingFrame dot = Prepare(0, cv::Mat(1, 1, CV_8UC3, cv::Scalar(9, 9, 9)), 0.5,
                                   cv::Mat(1, 1, CV_8U, cv::Scalar(255)), {}, {});
  EXPECT_EQ(dot.grey.size(), cv::Size(1, 1));
}

TEST(Preparation, SameBytesAtAnyThreadCount) {
  test::FrameLook look;
  look.noise = 3;
  cv::setNumThreads(1);
  const WorkingFrame one = PrepareAlone(look);
  cv::setNumThreads(2);
  const WorkingFrame two = PrepareAlone(look);
  cv::setNumThreads(-1);
  EXPECT_EQ(cv::norm(one.grey, two.grey, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.mask, two.mask, cv::NORM_INF), 0);
}
