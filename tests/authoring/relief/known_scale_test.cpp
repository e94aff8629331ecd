// RELIEF-14. The scale of a relief from lengths that the author knows.
#include "authoring/relief/make/known_scale.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "simulation/core/error.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::authoring {
namespace {

// A sphere of 40 mm about the portal, at half its true size.
constexpr double kRadius = 0.04, kShrunk = 0.5;

SweptSurface Sphere() {
  SweptSurface surface;
  surface.projection = {ProjectionType::kEquirectangular, {80, 80}, 1000, 1};
  surface.radius = cv::Mat(161, 161, CV_32F, cv::Scalar(kShrunk * kRadius));
  return surface;
}

glm::dvec3 TruePoint(const SweptSurface& surface, const glm::dvec2& pixel) {
  return kRadius * DirectionFromPixel(surface.projection, pixel);
}

TEST(ScaleOf, FindsTheScaleFromADistanceBetweenTwoCells) {
  const SweptSurface surface = Sphere();
  const glm::dvec2 a(70, 80), b(95, 88);
  const double metres = glm::length(TruePoint(surface, a) - TruePoint(surface, b));
  const ScalePart part = ScaleOf(KnownLength{metres, a, b}, surface);
  EXPECT_NEAR(part.factor, 1 / kShrunk, 1e-6);
  EXPECT_GT(part.sigma, 0);
  EXPECT_LT(part.sigma, 0.03) << "half a cell at each end of 25 cells";
  EXPECT_THROW(ScaleOf(KnownLength{metres, {-5, 0}, b}, surface), Error);
  EXPECT_THROW(ScaleOf(KnownLength{metres, a, a}, surface), Error);
}

TEST(ScaleOf, FindsTheScaleFromAnInstrumentThatTouchesTheTissue) {
  const SweptSurface surface = Sphere();
  const Lens lens = test::CavityLens();
  // The camera 10 mm in front of the portal; the shaft lies across the picture's middle.
  CameraPose pose;
  pose.centre = {0, 0, kShrunk * 0.010};
  constexpr double kDiameter = 0.004;
  const double half = std::asin(0.5 * kDiameter / (kRadius - 0.010 - 0.5 * kDiameter));
  const auto edge = [&](double angle) {
    return *PixelFromRay(lens, {std::sin(angle), 0, std::cos(angle)});
  };
  const KnownInstrument instrument{kDiameter, 3, edge(-half), edge(half)};
  EXPECT_NEAR(ScaleOf(instrument, lens, pose, surface).factor, 1 / kShrunk, 0.01)
      << "the surface is met in steps of a quarter percent";
  SweptSurface hole = surface;
  hole.radius = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ScaleOf(instrument, lens, pose, hole), Error);
}

}  // namespace
}  // namespace arthro::authoring
