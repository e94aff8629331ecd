// Errors that `bench view` reports, on pictures with a known error: nothing is drawn.
#include "app/bench/view/traced_agreement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/view/view_cases.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr int kSize = 96;

std::size_t IndexOf(const TracedPixel& pixel) {
  return static_cast<std::size_t>(pixel.y) * kSize + static_cast<std::size_t>(pixel.x);
}

// The tracer's own picture of a scene, held against its pixels.
class TracedAgreementOf : public testing::Test {
 protected:
  const LoadedScene loaded = WavyJoint(256);
  const Picture picture = ViewOfWavyJoint();
  const std::vector<TracedPixel> pixels = TracePixels(loaded, picture, kSize, 500);
  TracedPicture traced = TraceWindow(loaded.scene.backdrop, *loaded.panorama, picture.view,
                                     picture.field_of_view, kSize, {}, loaded.depth.get());
  TracedAgreement Compare(const ColourImage* colours = nullptr) const {
    const std::vector<float> distances(traced.distance.begin(), traced.distance.end());
    return CompareWithTraced(pixels, distances, kSize, colours);
  }
};

TEST_F(TracedAgreementOf, ThePixelsAreTheTracersWellInsideTheWindowAndTheSameEachTime) {
  ASSERT_EQ(pixels.size(), 500u);
  const std::vector<TracedPixel> again = TracePixels(loaded, picture, kSize, 500);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const TracedPixel& pixel = pixels[i];
    EXPECT_EQ(again[i].x, pixel.x);
    EXPECT_EQ(again[i].y, pixel.y);
    EXPECT_LE(std::hypot(pixel.x - 47.5, pixel.y - 47.5), 0.45 * kSize);
    EXPECT_EQ(pixel.distance, traced.distance[IndexOf(pixel)]);
  }
}

// Colours are rounded to bytes and distances to floats, no more.
TEST_F(TracedAgreementOf, ThePictureItselfIsAsItMustBe) {
  const TracedAgreement agreement = Compare(&traced.colours);
  EXPECT_EQ(agreement.compared, 500);
  EXPECT_EQ(agreement.elsewhere, 0);
  EXPECT_LT(agreement.rms, 1e-8);
  EXPECT_EQ(agreement.off_colour, 0);
  EXPECT_TRUE(std::isnan(Compare().off_colour)) << "none were given";
}

TEST_F(TracedAgreementOf, WhatIsOffIsCountedAndWhatIsNearlyRightIsMeasured) {
  // Every pixel of one in five: some pixels were chosen more than once.
  int far = 0;
  for (const TracedPixel& pixel : pixels) far += IndexOf(pixel) % 5 == 0 ? 1 : 0;
  ASSERT_GT(far, 50);
  for (std::size_t i = 0; i < traced.distance.size(); ++i) {
    traced.distance[i] += i % 5 == 0 ? 2e-4 : 5e-5;
    if (i % 5 == 0) traced.colours.rgb[3 * i + 1] ^= 0x40;
  }
  const TracedAgreement agreement = Compare(&traced.colours);
  EXPECT_DOUBLE_EQ(agreement.elsewhere, far / 500.0);
  EXPECT_NEAR(agreement.rms, 5e-5, 1e-8);
  EXPECT_DOUBLE_EQ(agreement.off_colour, far / 500.0);
}

TEST_F(TracedAgreementOf, AModelIsTracedToo) {
  const SurfaceMesh ring =
      Moved(Ring(0.007, 0.0024), Pose{{0.002, 0.004, 0.034}, glm::dquat(1, 0, 0, 0), 1.0});
  const ReferenceMesh mesh{&ring};
  int nearer = 0;
  for (const TracedPixel& pixel : TracePixels(loaded, picture, kSize, 500, {&mesh, 1}))
    nearer += pixel.distance < traced.distance[IndexOf(pixel)] - 1e-3 ? 1 : 0;
  EXPECT_GT(nearer, 20);
}

TEST_F(TracedAgreementOf, OfAPictureThatShowsNothingThereAreNoPixels) {
  Picture away = picture;
  away.view.view = -away.view.view;
  away.view.right = -away.view.right;
  EXPECT_TRUE(TracePixels(loaded, away, kSize, 500).empty());
  EXPECT_EQ(CompareWithTraced({}, {}, kSize).compared, 0);
}

}  // namespace
}  // namespace arthro::app
