#include "authoring/panorama/graph/focal_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "authoring/panorama/graph/links/pair_graph.h"
#include "tests/authoring/panorama/graph/simulated_clip.h"

namespace arthro::authoring {
namespace {

using namespace arthro::test;

constexpr int kFrames = 24;
constexpr double kNoise = 0.2;  // px, for every coordinate of a pair

Lens LensOf(double focal_px) {
  Lens lens;
  lens.width = lens.height = 800;
  lens.focal_px = focal_px;
  lens.cx = lens.cy = kCentre;
  lens.circle = {kCentre, kCentre, 300};
  return lens;
}

RectifiedView ViewWith(double focal_px) { return {800, 800, focal_px, kCentre, kCentre}; }

// Rectified pixel of the true lens under an equisolid lens of another focal length: r = 2 f
// sin(theta / 2) is unchanged.
cv::Point2d Seen(const cv::Point2d& p, double focal_px) {
  const cv::Point2d off = p - cv::Point2d(kCentre, kCentre);
  const double radius = std::hypot(off.x, off.y);
  if (radius == 0) return p;
  const double raw = 2 * kFocal * std::sin(std::atan(radius / kFocal) / 2);
  const double zoom = focal_px * std::tan(2 * std::asin(raw / (2 * focal_px))) / radius;
  return {kCentre + zoom * off.x, kCentre + zoom * off.y};
}

// Pair estimates for a lens file with `factor` times the true focal length.
std::vector<PairEstimate> SeenPairs(const std::vector<cv::Matx33d>& places, double factor) {
  std::mt19937 random(5);
  std::vector<PairEstimate> pairs;
  for (int step = 1; step <= 2; ++step)
    for (int i = 0; i < kFrames; ++i) {
      PairEstimate pair = NoisyPair(places, i, (i + step) % kFrames, kNoise, random);
      FourPoints from, to;
      for (std::size_t k = 0; k < 4; ++k) {
        from[k] = Seen(pair.control_in_a[k], factor * kFocal);
        to[k] = Seen(Move(pair.b_from_a, pair.control_in_a[k]), factor * kFocal);
      }
      pair.control_in_a = from;
      pair.b_from_a = FromFourPoints(from, to);
      pairs.push_back(pair);
    }
  return pairs;
}

FocalFit FitWith(const std::vector<PairEstimate>& pairs, double factor) {
  return FitFocal(kFrames, pairs, 0, LensOf(factor * kFocal), ViewWith(factor * kFocal), {});
}

TEST(FocalFit, FindsTheTrueLength) {
  const auto places = TruePlaces(kFrames, true);
  for (const double factor : {0.95, 0.98, 1.0, 1.03, 1.05}) {
    const FocalFit fit = FitWith(SeenPairs(places, factor), factor);
    std::printf("given %.2f of the true length, found %.4f +- %.4f\n", factor, factor * fit.factor,
                fit.deviation);
    ASSERT_TRUE(fit.is_determined) << factor;
    // Required: 1 %. A right lens must stay far below the 1 % that cause a warning.
    EXPECT_NEAR(factor * fit.factor, 1.0, factor == 1.0 ? 0.002 : 0.005) << factor;
  }
}

TEST(FocalFit, ErrorsOfAWrongLengthAreForeseen) {
  const auto places = TruePlaces(kFrames, true);
  const double factor = 1.05;
  const auto pairs = SeenPairs(places, factor);
  const FocalFit fit = FitWith(pairs, factor);
  const RectifiedView view = ViewWith(factor * kFocal);
  const Refined refined = Refine(pairs, LeastVarianceTree(kFrames, pairs, 0).root_from_frame, 0, {},
                                 Pinhole{view.focal_px, view.cx, view.cy});
  std::vector<cv::Point2d> seen;
  for (const cv::Point2d& p : NinePoints()) seen.push_back(Seen(p, view.focal_px));
  const auto foreseen = FocalErrors(refined.plane_from_frame, pairs, 0,
                                    FocalChange(LensOf(view.focal_px), view, fit.factor), seen, {});
  // The nine points are a centre and a ring, so that the lens's effect on them is a zoom.
  const double zoom = (seen[1].x - kCentre) / (NinePoints()[1].x - kCentre);
  std::vector<cv::Matx33d> true_points;
  for (const cv::Matx33d& place : refined.plane_from_frame)
    true_points.push_back(
        place * cv::Matx33d(zoom, 0, kCentre * (1 - zoom), 0, zoom, kCentre * (1 - zoom), 0, 0, 1));
  const auto errors = WorstErrors(true_points, places);
  int covered = 0;
  double worst = 0, most = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    covered += errors[i] <= 1.5 * foreseen[i] + 2;  // 2 px: error by the noise alone
    worst = std::max(worst, errors[i]);
    most = std::max(most, foreseen[i]);
  }
  std::printf("worst error %.1f px, foreseen %.1f px\n", worst, most);
  EXPECT_GT(worst, 3.0);
  EXPECT_GE(covered, kFrames * 95 / 100);
  EXPECT_LT(most, 3 * worst);
}

TEST(FocalFit, FramesThatDoNotMoveSayNothing) {
  const std::vector<cv::Matx33d> places(kFrames, PlaceOver(500, 500, kFocal, 0, 0, 0));
  const FocalFit fit = FitWith(SeenPairs(places, 1.05), 1.05);
  EXPECT_FALSE(fit.is_determined);
  EXPECT_EQ(fit.factor, 1.0);
  EXPECT_FALSE(FitFocal(2, {}, 0, LensOf(kFocal), ViewWith(kFocal), {}).is_determined);
}

}  // namespace
}  // namespace arthro::authoring
