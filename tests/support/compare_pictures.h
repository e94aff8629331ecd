// Compares two rendered pictures. The structural similarity of the worst 16x16 tile [Wang et al.
// 2004, on grey levels] detects small strong differences. The share of pixels that are off detects
// faint differences over the whole picture. A mean over the picture would hide both.
#pragma once

#include <string>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include "simulation/scene/image.h"

namespace arthro::test {

inline constexpr int kTile = 16;               // px
inline constexpr int kOff = 8;                 // in any channel, 0 to 255
inline constexpr double kMinTileSsim = 0.95;   // [method.md, Picture tests]
inline constexpr double kMaxShareOff = 0.002;  // [method.md, Picture tests]

struct PictureDifference {
  bool comparable = false;  // both have one size
  double worst_ssim = -1.0;
  glm::ivec2 worst_tile{0};  // its top-left pixel
  double share_off = 1.0;    // pixels with a channel off by more than kOff
  int max_difference = 255;

  bool passes() const {
    return comparable && worst_ssim >= kMinTileSsim && share_off <= kMaxShareOff;
  }
  std::string Sentence() const;
};

PictureDifference ComparePictures(const ColourImage& actual, const ColourImage& expected);

// Against tests/baselines/NAME.png. On failure NAME.actual.png and NAME.diff.png (differences eight
// times enlarged) are written to the folder `pictures` in the working directory. With
// ARTHRO_ACCEPT_PICTURES=1 in the environment the picture becomes the baseline: look at it first.
::testing::AssertionResult MatchesBaseline(const ColourImage& actual, const std::string& name);

// For pictures that must not pass: nothing is written.
PictureDifference DifferenceFromBaseline(const ColourImage& actual, const std::string& name);

}  // namespace arthro::test
