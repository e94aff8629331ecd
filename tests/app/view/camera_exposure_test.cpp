// Exposure of the camera, on levels made in code. Nothing is drawn.
#include "app/view/exposure/camera_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "app/view/drawing/grain.h"
#include "app/view/drawing/lens_shade.h"

namespace arthro::app {
namespace {

constexpr int kParts = 3000;

// Levels spread evenly from `low` to `high`.
std::vector<MeteredPart> Even(double low, double high) {
  std::vector<MeteredPart> parts;
  for (int i = 0; i < kParts; ++i) {
    const double level = low + (high - low) * (i + 0.5) / kParts;
    parts.push_back({glm::vec3(static_cast<float>(level)), true});
  }
  return parts;
}

double Shown(const std::vector<MeteredPart>& parts, double stored) {
  return 255 * CameraResponse(ExposureOf(parts), stored);
}

// Levels as the demo had them without a camera: 60 to 208 of 255.
TEST(CameraExposure, SpreadsANarrowPictureOverTheRange) {
  const auto parts = Even(60 / 255.0, 208 / 255.0);
  const auto at = [&](double share) { return (60 + share * 148) / 255; };
  EXPECT_LE(Shown(parts, at(0.01)), 25);
  EXPECT_GE(Shown(parts, at(0.99)), 240);
  int clipped = 0;
  for (const MeteredPart& part : parts) clipped += Shown(parts, part.rgb.r) >= 250 ? 1 : 0;
  EXPECT_GE(clipped, 0.01 * kParts);
  EXPECT_LE(clipped, 0.06 * kParts);
}

TEST(CameraExposure, NeverDimsAPictureNorLiftsItsBlack) {
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {0.02, 0.98}, {0.5, 1.0}, {0.0, 0.05}}) {
    const CameraExposure exposure = ExposureOf(Even(low, high));
    EXPECT_GE(exposure.gain, 1.0);
    EXPECT_LE(exposure.gain, 2.0);
    EXPECT_LE(exposure.offset, 1e-9);
  }
}

TEST(CameraExposure, ResponseRisesFromBlackToWhiteWithoutAStep) {
  for (const CameraExposure exposure : {CameraExposure{}, CameraExposure{1.7, -0.3}}) {
    EXPECT_EQ(CameraResponse(exposure, 0), 0);
    double before = 0;
    for (double stored = 0; stored <= 1.0; stored += 1e-4) {
      const double now = CameraResponse(exposure, stored);
      EXPECT_GE(now, before - 1e-12) << stored;
      EXPECT_LE(now, 1.0);
      // Slope of the line, and of the fade below kDarkEnd = 0.04 on top of it.
      EXPECT_LE(now - before, 1e-4 * (exposure.gain + 0.2 / 0.04)) << stored;
      before = now;
    }
  }
}

// A scope that looks past the end of its footage: the veil fills nine tenths of the window. By
// ranks over the whole window half of the lit part was white.
TEST(CameraExposure, TheVeilBesideALitPartDoesNotCountAsDarkTissue) {
  const std::vector<MeteredPart> lit = Even(0.2, 0.8);
  std::vector<MeteredPart> beside = Even(0.08, 0.085);
  for (std::size_t i = 0; i < lit.size(); i += 10) beside[i] = lit[i];
  // White is the mean of the ranks 95.5 % to 98.5 % of the lit part, and is shown as 1.03.
  const double white = 0.2 + 0.6 * 0.97;
  for (const CameraExposure exposure : {ExposureOf(lit), ExposureOf(beside)})
    EXPECT_NEAR(exposure.gain * white + exposure.offset, 1.03, 0.01);
}

// Nothing is lit where all is one level, so no rank is left: the level beyond the last one was
// read. As many parts as a vector that grows has room for let a sanitizer see it.
TEST(CameraExposure, APictureOfOneLevelHasTheLargestGain) {
  for (const float level : {0.0f, 0.1f, 0.25f}) {
    const std::vector<MeteredPart> parts(4096, MeteredPart{glm::vec3(level), true});
    EXPECT_EQ(ExposureOf(parts).gain, 2.0) << level;
  }
}

// A highlight that grows from nothing moves the exposure by small steps: a part of 3000 is 0.033 %,
// and the mean over 3 % of the ranks moves by a hundredth of the step at most.
TEST(CameraExposure, GrowingHighlightMovesTheExposureSmoothly) {
  auto parts = Even(0.2, 0.7);
  double before = ExposureOf(parts).gain;
  for (int i = 0; i < kParts / 10; ++i) {
    parts[static_cast<std::size_t>((i * 7919) % kParts)].rgb = glm::vec3(1.0f);
    const double now = ExposureOf(parts).gain;
    EXPECT_LE(std::abs(now - before), 0.02) << i;
    before = now;
  }
}

TEST(CameraExposure, InstrumentAndRimDoNotCount) {
  auto parts = Even(0.2, 0.7);
  const CameraExposure without = ExposureOf(parts);
  for (int i = 0; i < kParts; ++i) parts.push_back({glm::vec3(1.0f), false});
  EXPECT_EQ(ExposureOf(parts).gain, without.gain);
  EXPECT_EQ(ExposureOf(parts).offset, without.offset);
}

TEST(CameraExposure, CoveredLensChangesNothing) {
  auto parts = Even(0.2, 0.7);
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].counts = i % 20 == 0;
  EXPECT_EQ(ExposureOf(parts).gain, 1.0);
  EXPECT_EQ(ExposureOf({}).offset, 0.0);
}

// Rod of 1 mm radius across the view 10 mm ahead: its half width is atan(1.3 + 0.3 mm) = 9.1 deg.
TEST(CameraExposure, MeteringLeavesOutTheRaysThatMeetTheRod) {
  const LensRod rod{{-0.02, 0, -0.01}, {0.02, 0, -0.01}, 1e-3};
  const auto ray = [](double degrees) {
    const double angle = degrees * 0.017453292519943295;
    return glm::dvec3(0, std::sin(angle), -std::cos(angle));
  };
  EXPECT_TRUE(MeetsRod(ray(0), rod));
  EXPECT_TRUE(MeetsRod(ray(8.9), rod));
  EXPECT_FALSE(MeetsRod(ray(9.4), rod));
  EXPECT_FALSE(MeetsRod(-ray(0), rod)) << "behind the lens";
  EXPECT_FALSE(MeetsRod(ray(0), {{-0.02, 0, -0.01}, {-0.01, 0, -0.01}, 1e-3})) << "beside its end";
  EXPECT_FALSE(MeetsRod(ray(0), LensRod{}));
}

TEST(CameraExposure, GrainStaysWhileTheScopeRestsAndChangesWithItsMotion) {
  Picture picture;
  const int seed = GrainSeed(picture);
  EXPECT_EQ(GrainSeed(picture), seed);
  Picture moved = picture;
  moved.view.tip.x += 1e-7;
  EXPECT_NE(GrainSeed(moved), seed);
  picture.disturbances.time = 0.1;
  EXPECT_EQ(GrainSeed(picture), seed) << "nothing moves";
  picture.disturbances.haze = 0.5;
  EXPECT_NE(GrainSeed(picture), seed);
}

}  // namespace
}  // namespace arthro::app
