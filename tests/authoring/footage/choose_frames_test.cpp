#include "authoring/footage/choose_frames.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "authoring/footage/frame_look.h"
#include "tests/support/knee_picture.h"

namespace arthro::authoring {
namespace {

// A view of 160 x 120 into a larger picture, at (x, y).
cv::Mat View(int x, int y) {
  static const ColourImage knee = test::KneePicture(800, 400);
  const cv::Mat whole(knee.height, knee.width, CV_8UC3, const_cast<std::uint8_t*>(knee.rgb.data()));
  return whole(cv::Rect(x, y, 160, 120)).clone();
}

TEST(FrameLook, BlankFramesSayWhy) {
  FrameLooker looker;
  EXPECT_EQ(looker.Look(View(200, 100)).blank, "");
  const auto blank = [&](const cv::Scalar& colour) {
    return looker.Look(cv::Mat(120, 160, CV_8UC3, colour)).blank;
  };
  EXPECT_NE(blank({2, 2, 2}).find("black"), std::string::npos);
  EXPECT_NE(blank({255, 255, 255}).find("white"), std::string::npos);
  EXPECT_NE(blank({150, 40, 35}).find("red"), std::string::npos);
  EXPECT_NE(blank({90, 90, 90}).find("one colour"), std::string::npos);
}

TEST(FrameLook, NoiseOnABlankFrameIsNoDetail) {
  cv::Mat frame(480, 640, CV_8UC3, cv::Scalar(150, 40, 35));
  cv::Mat noise(frame.size(), CV_16SC3);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::NORMAL, 0, 5);
  frame.convertTo(frame, CV_16S);
  frame += noise;
  frame.convertTo(frame, CV_8U);
  EXPECT_NE(FrameLooker().Look(frame).blank, "");
}

TEST(FrameLook, BlurLowersSharpnessAndTheSurroundDoesNotRaiseIt) {
  cv::Mat sharp = View(200, 100), blurred;
  cv::GaussianBlur(sharp, blurred, {}, 2.0);
  FrameLooker looker;
  EXPECT_LT(looker.Look(blurred).sharpness, 0.7 * looker.Look(sharp).sharpness);
  // A black surround with a hard rim changes nothing once the window is known.
  const LensCircle window{80, 60, 55};
  cv::Mat surround(sharp.size(), CV_8UC1, cv::Scalar(255));
  cv::circle(surround, {80, 60}, 55, cv::Scalar(0), cv::FILLED);
  const double before = FrameLooker(window).Look(sharp).sharpness;
  sharp.setTo(cv::Scalar::all(0), surround);
  EXPECT_NEAR(FrameLooker(window).Look(sharp).sharpness, before, 0.02 * before);
}

TEST(FrameLook, MotionIsAShareOfTheWindow) {
  FrameLooker looker;
  EXPECT_EQ(looker.Look(View(200, 100)).moved, -1);           // no frame to compare with
  EXPECT_NEAR(looker.Look(View(212, 100)).moved, 0.1, 0.02);  // 12 of 120 px
  EXPECT_NEAR(looker.Look(View(212, 100)).moved, 0.0, 0.005);
}

TEST(FrameLook, FramesUnlikeTheClipAreBlankToo) {
  std::vector<FrameLook> looks(9);
  for (auto& look : looks) look = {120, 1.2, 0.6, 0.05, 0.1, 0.1, ""};
  looks[3] = {60, 2.5, 0.3, 0.008, 0.05, -1, ""};  // red glow, no detail
  looks[5].detail = 0.008;                         // blurred, but in the usual light: kept
  MarkBlanks(looks);
  for (std::size_t i = 0; i < looks.size(); ++i) EXPECT_EQ(!looks[i].blank.empty(), i == 3) << i;
}

TEST(ChooseFrames, AllOfAShortClipButBlanks) {
  std::vector<FrameLook> looks(20);
  looks[4].blank = "it is black";
  const auto reasons = ReasonsAgainst(looks, {});
  for (std::size_t i = 0; i < looks.size(); ++i) EXPECT_EQ(reasons[i].empty(), i != 4) << i;
  EXPECT_EQ(reasons[4], "blank: it is black");
  ChooseOptions keep;
  keep.skip_blank = false;
  EXPECT_EQ(ReasonsAgainst(looks, keep)[4], "");
  EXPECT_TRUE(ReasonsAgainst({}, {}).empty());
}

TEST(ChooseFrames, EveryFifth) {
  ChooseOptions options;
  options.every = 5;
  const auto reasons = ReasonsAgainst(std::vector<FrameLook>(12), options);
  for (std::size_t i = 0; i < reasons.size(); ++i) EXPECT_EQ(reasons[i].empty(), i % 5 == 0) << i;
}

TEST(ChooseFrames, OfALongClipTheSharpestOfEachEqualStretch) {
  // 600 frames that move, then 600 at rest: few frames of the rest are used.
  std::vector<FrameLook> looks(1200);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    looks[i].moved = i < 600 ? 0.01 : 0.0;
    looks[i].sharpness = i % 7 == 3 ? 0.2 : 0.1;
  }
  ChooseOptions options;
  options.most_frames = 60;
  const auto reasons = ReasonsAgainst(looks, options);
  int chosen = 0, at_rest = 0, sharp = 0;
  std::size_t before = 0, widest = 0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (!reasons[i].empty()) {
      EXPECT_NE(reasons[i].find("sharper"), std::string::npos);
      continue;
    }
    ++chosen;
    at_rest += i >= 600;
    sharp += looks[i].sharpness > 0.15;
    if (i < 600) widest = std::max(widest, i - before);
    before = i;
  }
  EXPECT_LE(chosen, 61);
  EXPECT_GE(chosen, 55);
  EXPECT_LT(at_rest, 10);
  EXPECT_GT(sharp, 0.9 * chosen);
  EXPECT_LE(widest, 22u);  // twice a stretch of 11 frames: no gap opens
}

}  // namespace
}  // namespace arthro::authoring
