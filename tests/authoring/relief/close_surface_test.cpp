// Closing on surfaces with a closed form. Cells are half a degree wide.
#include "authoring/relief/surface/close_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scene/relief_origin.h"

namespace arthro::authoring {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kCell = 0.5;    // degrees
constexpr double kSigma = 1e-4;  // m, of a measured cell

template <class Radius>
OpenSurface SurfaceOf(int width, int height, Radius&& radius) {
  OpenSurface open{
      cv::Mat(height, width, CV_32F), cv::Mat(height, width, CV_32F, cv::Scalar(kSigma)), {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) open.matched.at<float>(y, x) = static_cast<float>(radius(x, y));
  return open;
}

// Neither measured nor matched.
void Hide(OpenSurface& open, const cv::Rect& part) {
  open.matched(part).setTo(kUnknown);
  open.sigma(part).setTo(kUnknown);
}

ReliefOrigin OriginAt(const ClosedSurface& closed, int x, int y) {
  return static_cast<ReliefOrigin>(closed.origin.at<std::uint8_t>(y, x));
}

// Distance from the portal to a plane at a right angle to its axis.
double PlaneRadius(int x, int y) {
  const double longitude = RadiansFromDegrees(kCell * (x - 40)),
               latitude = RadiansFromDegrees(kCell * (y - 30));
  return 0.040 / (std::cos(longitude) * std::cos(latitude));
}

TEST(CloseSurface, SpansAHoleInAPlaneWithinTheMembranesOwnError) {
  OpenSurface open = SurfaceOf(80, 60, PlaneRadius);
  constexpr int kSide = 12;
  const cv::Rect hole(34, 24, kSide, kSide);
  Hide(open, hole);
  const ClosedSurface closed = CloseSurface(open);
  // ln r of a plane has a Laplacian of 1/cos² of either angle, together below 2.02 here. A membrane
  // over a square of side L then lies 0.0737 L² times that too low at most [Timoshenko &
  // Woinowsky-Krieger 1959]. A cell is added to the side,
  // since the rim of the hole lies on the centres of measured cells.
  const double side = RadiansFromDegrees(kCell * (kSide + 1));
  const double limit = 0.0737 * 2.02 * side * side * 0.040;
  for (int y = hole.y; y < hole.br().y; ++y)
    for (int x = hole.x; x < hole.br().x; ++x) {
      EXPECT_NEAR(closed.radius.at<float>(y, x), PlaneRadius(x, y), limit + kSigma);
      EXPECT_EQ(OriginAt(closed, x, y), ReliefOrigin::kInterpolated);
    }
  EXPECT_EQ(OriginAt(closed, 5, 5), ReliefOrigin::kMeasured);
}

TEST(CloseSurface, KeepsASphereAboutThePortalExactly) {
  OpenSurface open = SurfaceOf(60, 60, [](int, int) { return 0.045; });
  Hide(open, {20, 10, 30, 40});
  const ClosedSurface closed = CloseSurface(open);
  double least = 0, most = 0;
  cv::minMaxLoc(closed.radius, &least, &most);
  constexpr double kFloat = 1e-6;  // m: 0.045 m in 32 bits, and its logarithm
  EXPECT_NEAR(least, 0.045, kFloat);
  EXPECT_NEAR(most, 0.045, kFloat);
}

TEST(CloseSurface, LeavesNoRampAcrossAStep) {
  constexpr double kNear = 0.028, kFar = 0.040;  // m: a fold of 12 mm
  constexpr int kStepAt = 40;
  OpenSurface open = SurfaceOf(80, 50, [&](int x, int) { return x < kStepAt ? kNear : kFar; });
  // Nothing counts as measured to 4° on either side, where frames disagree about what is hidden.
  open.sigma(cv::Rect(kStepAt - 8, 0, 16, 50)).setTo(kUnknown);
  const ClosedSurface closed = CloseSurface(open);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 80; ++x) {
      const double r = closed.radius.at<float>(y, x);
      constexpr double kOnASide = 1e-3;  // m
      EXPECT_TRUE(std::abs(r - kNear) < kOnASide || std::abs(r - kFar) < kOnASide) << x << ' ' << r;
      constexpr int kEdge = 3;  // cells: 1.5°
      if (std::abs(x + 0.5 - kStepAt) > kEdge) {
        EXPECT_NEAR(r, x < kStepAt ? kNear : kFar, kOnASide);
      }
    }
}

TEST(CloseSurface, KnowsLessFurtherFromWhatWasMeasured) {
  OpenSurface open = SurfaceOf(
      100, 60, [](int x, int y) { return 0.040 + 2e-3 * std::sin(0.2 * x) * std::cos(0.15 * y); });
  Hide(open, {40, 0, 60, 60});
  const ClosedSurface closed = CloseSurface(open);
  EXPECT_FLOAT_EQ(closed.sigma.at<float>(30, 10), static_cast<float>(kSigma));
  double before = 0;
  for (const int x : {39, 44, 54, 74, 94}) {
    std::vector<float> row;
    for (int y = 0; y < 60; ++y) row.push_back(closed.sigma.at<float>(y, x));
    std::nth_element(row.begin(), row.begin() + 30, row.end());
    EXPECT_GT(row[30], before) << x;
    before = row[30];
  }
}

TEST(CloseSurface, TakesAnEstimateWhereNothingWasMeasured) {
  OpenSurface open = SurfaceOf(80, 60, [](int, int) { return 0.045; });
  const cv::Rect hole(30, 20, 20, 20);
  Hide(open, hole);
  open.estimate = cv::Mat(60, 80, CV_32F, cv::Scalar(kUnknown));
  open.estimate_sigma = open.estimate.clone();
  open.estimate(hole).setTo(0.040);
  open.estimate_sigma(hole).setTo(1e-5);
  const ClosedSurface closed = CloseSurface(open);
  EXPECT_NEAR(closed.radius.at<float>(30, 40), 0.040, 1e-4);
  EXPECT_EQ(OriginAt(closed, 40, 30), ReliefOrigin::kBrightness);
  EXPECT_LT(closed.sigma.at<float>(30, 40), 1e-4);
}

TEST(CloseSurface, OfNothingMeasuredIsEmpty) {
  OpenSurface open = SurfaceOf(20, 20, [](int, int) { return 0.04; });
  open.sigma.setTo(kUnknown);
  EXPECT_TRUE(CloseSurface(open).radius.empty());
}

}  // namespace
}  // namespace arthro::authoring
