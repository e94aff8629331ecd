// Hard cases PAN-01 to PAN-08: effects of tissue, water and the surgeon on a clip. The limits are
// for 800 x 640 footage (case_run.h); the tests print the numbers reached.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/authoring/panorama/cases/case_run.h"

namespace arthro::test {
namespace {

using namespace arthro::authoring;

// At least `share` of the frames are right, and no wrong frame has an expected error of a right
// one.
void ExpectRight(const ClipScore& score, double share) {
  EXPECT_GE(score.right, share * score.frames) << score.Text();
  EXPECT_EQ(score.wrong_as_good, 0) << score.Text();
}

TEST(HardCase01, FaintTextureIsPlacedOrSaidToBeTooFaint) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kFaint, 14));
  Tell("faint", run);
  const ClipScore score = run.Score();
  ExpectRight(score, 0.8);
}

TEST(HardCase02, BlankFramesAreNamedAndTheRestIsRight) {
  const Clip clip(CaseOptions(ClipPreset::kBlank, 14));
  CaseSetting setting;
  setting.has_blanks = true;
  const CaseRun run = RunCase(clip, setting);
  Tell("blank", run);
  int blanks = 0;
  for (int i = 0; i < clip.frames(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    blanks += clip.IsBlank(i);
    EXPECT_EQ(!run.looks[at].blank.empty(), clip.IsBlank(i)) << i << run.looks[at].blank;
    // Blank frames that are registered all the same are not placed.
    EXPECT_EQ(run.results[at].is_placed, !clip.IsBlank(i)) << i << run.results[at].reason;
    EXPECT_EQ(run.results[at].reason.empty(), run.results[at].is_placed);
  }
  EXPECT_EQ(blanks, 4);
  EXPECT_EQ(run.Score().right, clip.frames() - blanks);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
}

TEST(HardCase03, AJumpWithOverlapStaysOnePiece) {
  ClipOptions options = CaseOptions(ClipPreset::kJump, 12);
  options.jump = 0.5;  // 150 px on top of a step of 100 px, and 20 degrees
  const CaseRun run = RunCase(options);
  Tell("jump", run);
  EXPECT_EQ(run.report.components, 1);
  ExpectRight(run.Score(), 1);
}

// Each half of the clip is a piece of its own, all of it right, and the user is told.
void ExpectTwoHalves(const CaseRun& run) {
  EXPECT_EQ(run.report.components, 2);
  EXPECT_FALSE(run.report.warnings.empty());
  const int half = static_cast<int>(run.results.size()) / 2;
  for (const int piece : {0, 1}) {
    const ClipScore score = run.Score(piece);
    EXPECT_EQ(score.placed, half) << piece;
    EXPECT_EQ(score.right, half) << piece << ": " << score.Text();
  }
}

// 317 px and 20 degrees on top of the step: the views have 9 to 16 % in common, mostly at the rim.
// Under the true homography their similarity is 8.4 deviations above chance, and 9 are required, so
// two pieces are the right result.
TEST(HardCase03, AJumpOf317PxIsNeverMergedWrongly) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kJump, 14));
  Tell("jump 317 px", run);
  if (run.report.components == 1)
    ExpectRight(run.Score(), 1);
  else
    ExpectTwoHalves(run);
}

TEST(HardCase03, AJumpWithoutOverlapIsTwoPieces) {
  ClipOptions options = CaseOptions(ClipPreset::kJump, 12);
  options.path = ClipPath::kStrip;
  options.jump = 6;  // 1800 px
  const CaseRun run = RunCase(options);
  Tell("jump away", run);
  ExpectTwoHalves(run);
}

TEST(HardCase04, AToolDoesNotPullTheFrames) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kTool, 14));
  Tell("tool", run);
  ExpectRight(run.Score(), 0.95);
  EXPECT_LE(run.Score().mean_px, 1.5);
}

TEST(HardCase05, TenEqualPosesAreTheIdentity) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kStill, 10));
  Tell("still", run);
  const cv::Matx33d first = run.results[0].panorama_from_rectified.inv();
  double worst = 0;
  for (const FrameResult& result : run.results) {
    ASSERT_TRUE(result.is_placed) << result.reason;
    ASSERT_TRUE(std::isfinite(result.expected_error_px) && std::isfinite(result.rms_px));
    const cv::Matx33d move = first * result.panorama_from_rectified;
    for (const cv::Point2d& p : run.nine) worst = std::max(worst, cv::norm(Apply(move, p) - p));
  }
  std::printf("    worst %.3f px from the identity\n", worst);
  RecordProperty("worst_px", std::to_string(worst));
  EXPECT_LE(worst, 0.1);
}

// 30 frames of 100 px; the far ends are the worst of the nine points of the first and last frame.
TEST(HardCase06, AStripDriftsLittleOver3000Px) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kStrip, 30));
  Tell("strip", run);
  ExpectRight(run.Score(), 1);
  EXPECT_LE(run.Score().max_px, 6.0);
}

// Mean over the nine points of all placed frames, right or not.
double MeanOfAll(const CaseRun& run) {
  const cv::Matx33d truth_from_panorama = run.Score().truth_from_panorama;
  double sum = 0;
  int points = 0;
  for (std::size_t i = 0; i < run.results.size(); ++i)
    for (const cv::Point2d& p : run.nine) {
      if (!run.results[i].is_placed || run.results[i].component != 0) continue;
      const cv::Matx33d found = truth_from_panorama * run.results[i].panorama_from_rectified;
      sum += cv::norm(Apply(found, p) - Apply(run.truth[i], p));
      ++points;
    }
  return sum / points;
}

// Relief of 9 px looks flat pair by pair; only the rule of the calibrated camera reveals it. Its
// frames are up to 15 px off, and none of them may pass as right.
TEST(HardCase07, ShallowReliefIsWarnedOfToo) {
  ClipOptions options = CaseOptions(ClipPreset::kRelief, 16);
  options.relief = 0.03;
  const CaseRun run = RunCase(options);
  Tell("shallow relief", run);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
  EXPECT_GE(run.Score().covered, 0.95);
  EXPECT_FALSE(run.report.warnings.empty());
}

// A height field of 30 px, seen from 430 px. At the rim of a frame a height of h is displaced by
// 0.8 h from the mean plane, more than the required 4 px on average, and no homography follows it.
// Required instead: no fold, a warning, and honest expected errors.
TEST(HardCase07, ReliefDoesNotFoldAndIsWarnedOf) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kRelief, 16));
  Tell("relief", run);
  const double mean = MeanOfAll(run);
  std::printf("    mean of all frames %.2f px\n", mean);
  RecordProperty("mean_of_all_px", std::to_string(mean));
  ASSERT_FALSE(run.report.warnings.empty());
  EXPECT_NE(run.report.warnings[0].find("parallax"), std::string::npos);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
  EXPECT_EQ(run.Score().placed, 16);
  EXPECT_LE(mean, 15.0);  // required: 4; see above for the reason
  // No fold: every frame keeps its orientation all over its window.
  for (const FrameResult& result : run.results) {
    const cv::Matx33d& h = result.panorama_from_rectified;
    for (const cv::Point2d& p : run.nine) {
      const double w = h(2, 0) * p.x + h(2, 1) * p.y + h(2, 2);
      EXPECT_GT(cv::determinant(h) / (w * w * w), 0) << result.index;
    }
  }
}

TEST(HardCase08, LightThatShadesBumpsDoesNotPullTheFrames) {
  const CaseRun run = RunCase(CaseOptions(ClipPreset::kBumpy, 16));
  Tell("bumpy", run);
  ExpectRight(run.Score(), 0.9);
  EXPECT_LE(run.Score().mean_px, 2.0);
}

}  // namespace
}  // namespace arthro::test
