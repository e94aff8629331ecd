#include "app/editor/pictures/render_scale.h"

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

// A machine: what a frame takes at full size, s, and what of it goes by the number of pixels.
struct Machine {
  double fixed, by_pixels;
  double At(double scale) const { return fixed + by_pixels * scale * scale; }
};

int Draw(RenderScale& scale, const Machine& machine, int frames, double noise = 0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(1 - noise, 1 + noise);
  int changes = 0;
  for (int i = 0; i < frames; ++i) {
    const double before = scale.value();
    scale.Note(machine.At(before) * off(random));
    changes += scale.value() != before ? 1 : 0;
  }
  return changes;
}

TEST(RenderScale, AQuickMachineDrawsAtFullSize) {
  RenderScale scale;
  EXPECT_EQ(Draw(scale, {0.004, 0.028}, 500, 0.05), 0);
  EXPECT_EQ(scale.value(), 1.0);
  EXPECT_FALSE(scale.is_slow());
}

TEST(RenderScale, ASlowMachineKeepsToTheFrameTimeAsFinelyAsItCan) {
  for (const Machine machine : {Machine{0.003, 0.045}, {0.005, 0.060}, {0.002, 0.080}}) {
    RenderScale scale;
    Draw(scale, machine, 30);
    EXPECT_LE(machine.At(scale.value()), 1.15 * RenderScale::kFrameTime);
    // One step finer would be too slow.
    EXPECT_GT(machine.At(scale.value() + 0.1), 1.15 * RenderScale::kFrameTime);
    EXPECT_TRUE(scale.is_slow());
  }
}

TEST(RenderScale, DoesNotSwingWhereFramesAreUneven) {
  for (double by_pixels = 0.02; by_pixels < 0.2; by_pixels *= 1.1) {
    RenderScale scale;
    const Machine machine{0.004, by_pixels};
    Draw(scale, machine, 30);
    // A tenth of unevenness a frame: its median of five stays within half of the band.
    EXPECT_LE(Draw(scale, machine, 1000, 0.1), 1) << by_pixels;
  }
}

TEST(RenderScale, NeverCoarserThanHalf) {
  RenderScale scale;
  Draw(scale, {0.5, 3}, 100);
  EXPECT_EQ(scale.value(), 0.5);
}

TEST(RenderScale, OneLongFrameChangesNothing) {
  RenderScale scale;
  Draw(scale, {0.004, 0.020}, 10);
  scale.Note(2.0);
  Draw(scale, {0.004, 0.020}, 10);
  EXPECT_EQ(scale.value(), 1.0);
}

TEST(RenderScale, ComesBackWhenThereIsLessToDraw) {
  RenderScale scale;
  Draw(scale, {0.004, 0.100}, 30);
  ASSERT_LT(scale.value(), 0.7);
  Draw(scale, {0.004, 0.010}, 30);
  EXPECT_EQ(scale.value(), 1.0);
}

TEST(RenderScale, WhatIsNoTimeIsPassedOver) {
  RenderScale scale;
  for (const double seconds : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    for (int i = 0; i < 10; ++i) scale.Note(seconds);
  EXPECT_EQ(scale.value(), 1.0);
}

TEST(RenderScale, FeaturesStepBackBeforeTheResolutionAndInTheirOrder) {
  RenderScale scale;
  CameraFeatures before = scale.features();
  EXPECT_EQ(before, CameraFeatures::kOcclusion);
  // Each round of frames is a little slower than the one before.
  for (double seconds = 0.03; seconds < 0.06; seconds *= 1.004) {
    const double cost = scale.value();
    for (int i = 0; i < 5; ++i) scale.Note(seconds * cost * cost);
    EXPECT_LE(scale.features(), before);
    if (scale.value() < 1) {
      EXPECT_EQ(scale.features(), CameraFeatures::kExposure);
    }
    before = scale.features();
  }
  EXPECT_LT(scale.value(), 1);
}

// A machine that is always just too slow takes every step of the order [method.md, Camera], the
// same ones each time.
TEST(RenderScale, EachFeatureHasItsStepAndTheOrderIsTheSameEachTime) {
  std::vector<std::pair<double, CameraFeatures>> expected;
  for (const CameraFeatures features :
       {CameraFeatures::kOcclusion, CameraFeatures::kEdges, CameraFeatures::kFringe,
        CameraFeatures::kSharpness, CameraFeatures::kGrain, CameraFeatures::kExposure})
    expected.emplace_back(1.0, features);
  for (const double coarser : {0.9, 0.8, 0.7, 0.6, 0.5})
    expected.emplace_back(coarser, CameraFeatures::kExposure);
  for (int round = 0; round < 2; ++round) {
    RenderScale scale;
    std::vector<std::pair<double, CameraFeatures>> steps{{scale.value(), scale.features()}};
    for (int i = 0; i < 200; ++i) {
      scale.Note(1.151 * RenderScale::kFrameTime);
      if (const std::pair now(scale.value(), scale.features()); now != steps.back())
        steps.push_back(now);
    }
    EXPECT_EQ(steps, expected);
  }
}

}  // namespace
}  // namespace arthro::app
