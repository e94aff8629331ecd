// Masks of highlights, instruments, and marks that are fixed to the camera.
#include "authoring/panorama/preparation/frame_masks.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "authoring/panorama/preparation/clip_look.h"
#include "tests/authoring/panorama/preparation/synthetic_frames.h"

using namespace arthro;
using namespace arthro::authoring;

namespace {

constexpr int kFrameSize = 220;

double ShareIn(const cv::Mat& mask, const cv::Mat& region) {
  return static_cast<double>(cv::countNonZero(mask & region)) /
         std::max(1, cv::countNonZero(region));
}

// A clip that moves `step` px per frame, with text and a spot of dirt fixed to the camera.
ClipLook LookAtClip(int frames, double step, bool has_marks, cv::Mat* marks) {
  *marks = cv::Mat::zeros(kFrameSize, kFrameSize, CV_8U);
  cv::putText(*marks, "KNEE 7", {60, 80}, cv::FONT_HERSHEY_SIMPLEX, 0.7, 255, 2);
  cv::Mat dirt = cv::Mat::zeros(kFrameSize, kFrameSize, CV_8U);
  cv::circle(dirt, {140, 150}, 5, 255, -1);
  ClipLookBuilder builder;
  for (int i = 0; i < frames; ++i) {
    test::FrameLook look;
    look.dx = step * i;
    look.dy = 0.4 * step * i;
    look.noise = 2;
    look.seed = i;
    cv::Mat rgb = test::MakeFrame(kFrameSize, look);
    if (has_marks) {
      rgb.setTo(cv::Scalar(230, 230, 90), *marks);
      cv::Mat darker = rgb * 0.7;
      darker.copyTo(rgb, dirt);
    }
    builder.Add(rgb, test::RoundWindow(kFrameSize));
  }
  *marks |= dirt;
  return builder.Finish();
}

}  // namespace

TEST(FrameMasks, GlintsAreFoundAndTissueIsKept) {
  test::FrameLook look;
  look.noise = 2;
  cv::Mat rgb = test::MakeFrame(kFrameSize, look),
          glints = cv::Mat::zeros(kFrameSize, kFrameSize, CV_8U);
  for (int i = 0; i < 12; ++i) cv::circle(glints, {60 + 9 * i, 70 + (i * 37) % 80}, 2, 255, -1);
  const cv::Mat before = HighlightMask(rgb, test::RoundWindow(kFrameSize));
  EXPECT_LT(ShareIn(before, test::RoundWindow(kFrameSize)), 0.01);
  rgb.setTo(cv::Scalar(250, 245, 240), glints);
  const cv::Mat after = HighlightMask(rgb, test::RoundWindow(kFrameSize));
  EXPECT_GT(ShareIn(after, glints), 0.99);
  // A disc of radius 2 grown by 2 has three times its area; half as much again is allowed.
  EXPECT_LT(cv::countNonZero(after), 4.5 * cv::countNonZero(glints) + cv::countNonZero(before));
}

TEST(FrameMasks, AnInstrumentIsFoundAndPaleTissueIsNot) {
  const cv::Mat window = test::RoundWindow(kFrameSize);
  cv::Mat rgb = test::MakeFrame(kFrameSize, {}),
          shaft = cv::Mat::zeros(kFrameSize, kFrameSize, CV_8U);
  EXPECT_EQ(cv::countNonZero(ToolMask(rgb, window)), 0);
  // Cartilage: pale, nearly colourless, but without straight sides.
  cv::Mat pale = rgb.clone();
  cv::circle(pale, {110, 60}, 50, {210, 206, 204}, -1);
  EXPECT_EQ(cv::countNonZero(ToolMask(pale, window)), 0);
  cv::line(shaft, {110, 110}, {230, 190}, 255, 24);
  rgb.setTo(cv::Scalar(150, 150, 152), shaft);
  const cv::Mat tool = ToolMask(rgb, window);
  EXPECT_GT(ShareIn(tool, shaft & window), 0.95);
  EXPECT_LT(ShareIn(tool, window & ~shaft), 0.12);
}

TEST(FrameMasks, TextAndDirtThatStayWhileTissueMovesAreMarks) {
  // PAN-14. The marks are grown by 3 px, so they cover the text and its edges.
  cv::Mat marks;
  const ClipLook look = LookAtClip(16, 13.0, true, &marks);
  ASSERT_FALSE(look.static_marks.empty());
  EXPECT_GT(ShareIn(look.static_marks, marks), 0.95);
  cv::Mat around;
  cv::dilate(marks, around, cv::getStructuringElement(cv::MORPH_ELLIPSE, {17, 17}));
  EXPECT_LT(ShareIn(look.static_marks, test::RoundWindow(kFrameSize) & ~around), 0.01);
}

TEST(FrameMasks, AClipWithoutMarksHasNone) {
  cv::Mat marks;
  const ClipLook look = LookAtClip(16, 13.0, false, &marks);
  const cv::Mat window = test::RoundWindow(kFrameSize);
  EXPECT_LT(look.static_marks.empty() ? 0 : ShareIn(look.static_marks, window), 0.005);
}

TEST(FrameMasks, AStillClipKeepsItsTexture) {
  // PAN-05: in ten frames of one pose nothing averages away.
  cv::Mat marks;
  const ClipLook look = LookAtClip(10, 0.0, false, &marks);
  EXPECT_TRUE(look.static_marks.empty());
  EXPECT_EQ(look.frames, 10);
}

TEST(ClipLook, TheSharedLightIsTheFalloff) {
  // exp(-1.2 r²) under gamma 2.2: the logarithm drops by 1.2 / 2.2 from the centre to r = 1.
  cv::Mat marks;
  const ClipLook look = LookAtClip(16, 13.0, false, &marks);
  const double drop =
      look.light.at<float>(kFrameSize / 2, kFrameSize / 2) -
      look.light.at<float>(kFrameSize / 2, kFrameSize / 2 + static_cast<int>(0.4 * kFrameSize));
  EXPECT_NEAR(drop, 1.2 / 2.2 * 0.8 * 0.8, 0.05);
}

TEST(ClipLook, NoiseIsMeasuredByBrightness) {
  cv::Mat marks;
  const ClipLook look = LookAtClip(12, 13.0, false, &marks);
  // Noise 2 in each channel; mixed by 0.15, 0.6, 0.25: 2 · 0.667 = 1.33 grey levels.
  EXPECT_NEAR(look.noise.At(120), 1.33, 0.3);
}
