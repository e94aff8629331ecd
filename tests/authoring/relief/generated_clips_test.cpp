// A clip that another program rendered, with truth that only tests/support reads: poses and surface
// within goals.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "authoring/relief/make/make_relief.h"
#include "simulation/core/units.h"
#include "tests/support/relief/generated_clip.h"
#include "tests/support/relief/surface_score.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

struct Measured {
  test::CavityTruth truth;
  test::TrueSurface surface;
  ReliefResult result;
};

Measured MeasureClip(const std::filesystem::path& folder) {
  Measured made;
  made.truth = test::ReadCavityTruth(folder);
  made.surface = test::SurfaceOf(made.truth);
  ReliefRequest request;
  request.footage = folder / "frames";
  request.lens = made.truth.lens;
  request.options.view_angle = made.truth.view_angle;
  request.draws_panorama = false;
  made.result = MakeRelief(request, {});
  return made;
}

// Cells that count as measured only.
ReliefResult MeasuredPartOf(ReliefResult result) {
  for (std::size_t i = 0; i < result.relief.relief.size(); ++i)
    if (result.origin.origin[i] != ReliefOrigin::kMeasured)
      result.relief.relief[i] = std::numeric_limits<float>::quiet_NaN();
  return result;
}

// The preset easy at two thirds of its width and with 20 of its 28 frames, so that it takes
// seconds: a pixel is half as large again and the path shorter, so that the goals of the preset
// medium hold.
TEST(GeneratedClip, IsPosedAndMeasuredWithinTheGoals) {
  ARTHRO_REQUIRE_GENERATOR(generator);
  const test::TempFolder folder;
  ASSERT_TRUE(
      test::GenerateClip(generator, folder.path(),
                         "--preset easy --seed 502 --set n=20 turns=1.07 w=320 h=266 circle=126 "
                         "cx_off=1.3 cy_off=-1"));
  const auto [truth, surface, result] = MeasureClip(folder.path());
  ASSERT_TRUE(result.report.verdict.is_measured()) << result.report.verdict.sentence;

  const test::PoseScore poses = test::ScorePoses(result.report, truth);
  EXPECT_EQ(poses.posed, 20);
  EXPECT_LT(MmFromMetres(poses.path), 0.15) << "mm";
  EXPECT_LT(DegreesFromRadians(poses.rotation), 1);
  EXPECT_LT(MmFromMetres(poses.portal), 0.5) << "mm";

  const auto found = test::SurfaceOf(MeasuredPartOf(result), truth, surface);
  ASSERT_TRUE(found);
  const test::SurfaceScore score = test::ScoreSurface(*found, surface);
  EXPECT_GT(score.coverage, 0.7);
  EXPECT_GT(score.within_1mm, 0.8);
  EXPECT_GT(score.spearman, 0.93);
}

// Cells within 3° of the edge of a fold that count as measured.
struct EdgeScore {
  int cells = 0;
  double off = 0;        // share that is 3 mm from all tissue within 1.5°
  double ramp = 0;       // share between the two sides, 3 mm from either
  double true_ramp = 0;  // the same of the tissue
};

EdgeScore ScoreEdge(const DepthMap& found, const test::TrueSurface& surface) {
  constexpr float kOff = 3e-3f, kStep = 2.5e-3f;  // m; a step: over a degree
  constexpr int kNear = 6, kReach = 3;            // cells of half a degree
  const int width = found.width, height = found.height;
  const DepthMap& truth = surface.radius;
  cv::Mat is_smooth(height, width, CV_8U, cv::Scalar(255)), distance;
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x)
      if (std::abs(truth.at(x - 1, y) - truth.at(x + 1, y)) > kStep ||
          std::abs(truth.at(x, y - 1) - truth.at(x, y + 1)) > kStep)
        is_smooth.at<std::uint8_t>(y, x) = 0;
  cv::distanceTransform(is_smooth, distance, cv::DIST_L2, 5);
  EdgeScore score;
  for (int y = kReach; y + kReach < height; ++y)
    for (int x = kReach; x + kReach < width; ++x) {
      const float r = found.at(x, y);
      if (!std::isfinite(r) || distance.at<float>(y, x) > kNear ||
          surface.seen_by[static_cast<std::size_t>(y * width + x)] < 3)
        continue;
      float off = 1, low = 1, high = 0;
      for (int j = -kReach; j <= kReach; ++j)
        for (int i = -kReach; i <= kReach; ++i) {
          if (i * i + j * j > kReach * kReach) continue;
          const float t = truth.at(x + i, y + j);
          off = std::min(off, std::abs(r - t));
          low = std::min(low, t), high = std::max(high, t);
        }
      const auto is_between = [&](float radius) {
        return radius > low + kOff && radius < high - kOff;
      };
      ++score.cells;
      score.off += off > kOff;
      score.ramp += is_between(r);
      score.true_ramp += is_between(truth.at(x, y));
    }
  for (double* share : {&score.off, &score.ramp, &score.true_ramp})
    *share /= std::max(1, score.cells);
  return score;
}

// RELIEF-15. A fold of 12 mm that hides what lies behind it. 4 %: the goal of the preset hard for
// cells that are called confident and are off by more than 3 mm.
TEST(GeneratedClip, HasTheEdgeOfAFoldWithin15DegreesAndNoRamp) {
  ARTHRO_REQUIRE_GENERATOR(generator);
  const test::TempFolder folder;
  ASSERT_TRUE(test::GenerateClip(generator, folder.path(),
                                 "--preset step --seed 602 --set n=16 turns=0.75"));
  const Measured made = MeasureClip(folder.path());
  ASSERT_TRUE(made.result.report.verdict.is_measured()) << made.result.report.verdict.sentence;
  const auto found = test::SurfaceOf(MeasuredPartOf(made.result), made.truth, made.surface);
  ASSERT_TRUE(found);
  const EdgeScore score = ScoreEdge(found->radius, made.surface);
  EXPECT_GT(score.cells, 300) << "near the edge";
  EXPECT_LT(score.off, 0.04);
  EXPECT_LT(score.ramp, score.true_ramp + 0.04) << score.true_ramp;
}

}  // namespace
}  // namespace arthro::authoring
