// Hard cases of the relief that tracks alone decide, with known truth: the camera head, a portal
// that slides, tissue that moves, a wrong lens, two clips.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "authoring/relief/make/verdict.h"
#include "authoring/relief/motion/growth.h"
#include "authoring/relief/motion/motion.h"
#include "authoring/relief/motion/portal.h"
#include "authoring/relief/motion/self_calibration.h"
#include "simulation/core/units.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::authoring {
namespace {

using test::CavityOptions;
using test::ScopeMotion;

struct Solved {
  std::vector<Track> tracks;
  Motion motion;
};

Solved SolvedFrom(const CavityOptions& options) {
  Solved solved{test::CavityTracks(options), {}};
  solved.motion =
      SolveMotion(solved.tracks, options.frames, LensProfile(test::CavityLensFile(options)), {});
  return solved;
}

// RELIEF-02. The shafts of an insertion are one line, so that they place no portal.
TEST(SolveMotion, PosesAPureInsertionWithoutAPortal) {
  CavityOptions options;
  options.motion = ScopeMotion::kPlunge;
  const Motion motion = SolvedFrom(options).motion;
  EXPECT_EQ(PosedFrames(motion.scene), options.frames);
  EXPECT_TRUE(JudgeMotion(motion).is_measured()) << JudgeMotion(motion).sentence;
  const PivotFit fit = FindPivot(motion.scene.poses, test::kViewAngle);
  EXPECT_LT(fit.shaft_spread, RadiansFromDegrees(2)) << "the least that a portal needs";
}

// RELIEF-04. Tissue that swells on one side moves neighbouring points alike. A swelling of the
// whole can hardly be told from a motion of the camera.
TEST(JudgeMotion, JudgesMovingTissueByTheResidualThatNeighboursShare) {
  CavityOptions options;
  options.frames = 18;
  const double at_rest = SolvedFrom(options).motion.coherent_residual_px;
  options.breath = 0.002;
  Motion motion = SolvedFrom(options).motion;
  EXPECT_GT(motion.coherent_residual_px, 2 * at_rest);
  motion.coherent_residual_px = 1.4;
  EXPECT_TRUE(JudgeMotion(motion).is_measured()) << "below the limit of 1.5 px";
  motion.coherent_residual_px = 1.6;
  EXPECT_EQ(JudgeMotion(motion).kind, "tissue_moves");
}

// RELIEF-09.
TEST(FitFocal, FindsAFocalLengthThatTheLensFileHasWrong) {
  for (const double factor : {1.03, 0.95}) {
    CavityOptions options;
    options.focal_factor = factor;
    const Solved solved = SolvedFrom(options);
    const FocalFit fit = FitFocal(solved.tracks, test::CavityLensFile(options), solved.motion);
    EXPECT_NEAR(fit.factor * factor, 1, 0.01) << "the goal: within 1 %";
    EXPECT_GT(fit.sigma, 0);
    EXPECT_LT(fit.sigma, 0.02);
  }
}

// RELIEF-09. A right lens is left alone: the limits are 2 % of the focal length and 10 % of the
// rms.
TEST(FitFocal, LeavesARightFocalLengthAlone) {
  const CavityOptions options;
  const Solved solved = SolvedFrom(options);
  const FocalFit fit = FitFocal(solved.tracks, test::CavityLens(), solved.motion);
  EXPECT_NEAR(fit.factor, 1, 0.01);
  EXPECT_GT(fit.rms_px, 0.9 * fit.rms_before_px);
}

std::vector<std::optional<CameraPose>> TruePoses(const CavityOptions& options) {
  std::vector<std::optional<CameraPose>> poses;
  for (const CameraPose& pose : test::CavityPoses(options)) poses.emplace_back(pose);
  return poses;
}

// RELIEF-10.
TEST(FindPivot, FollowsACameraHeadThatIsHeldUpright) {
  CavityOptions options;
  options.frames = 24;
  options.head_upright = true;
  options.roll = 0.7;  // 40° either way
  const auto poses = SolvedFrom(options).motion.scene.poses;
  const PivotFit fit = FindPivot(poses, test::kViewAngle);
  EXPECT_EQ(fit.head, HeadMotion::kWandering);
  const std::vector<double> truth = test::CavityHeadTurns(options);
  for (std::size_t f = 0; f < poses.size(); ++f) {
    if (!poses[f]) continue;
    EXPECT_NEAR(std::remainder(fit.head_turns[f] - truth[f], 2 * M_PI), 0, RadiansFromDegrees(3))
        << "the goal: within 3°; frame " << f;
  }
  const PivotFit straight = FindPivot(poses, test::kViewAngle, true);
  const double miss = straight.median_miss / straight.median_insertion;
  EXPECT_FALSE(JudgePivot(miss, straight.shaft_spread).is_measured())
      << "a head taken as straight must be refused; miss " << miss;
}

// RELIEF-11.
TEST(FindPivot, GivesEachSideOfASlideItsOwnPortal) {
  CavityOptions options;
  options.frames = 20;
  options.slide = 0.005;
  const PivotFit fit = FindPivot(TruePoses(options), test::kViewAngle);
  ASSERT_EQ(fit.stretches.size(), 2u);
  EXPECT_EQ(fit.stretches[1].first, 10) << "the first frame after the slide";
  EXPECT_NEAR((fit.stretches[1].point - fit.stretches[0].point).norm(), 0.005, 1e-6);
  EXPECT_LT(fit.median_miss, 1e-6);
}

// RELIEF-11. Skin that gives by little is one portal.
TEST(FindPivot, KeepsOnePortalWhereTheSkinGivesALittle) {
  CavityOptions options;
  options.frames = 20;
  options.slide = 0.0005;
  EXPECT_EQ(FindPivot(TruePoses(options), test::kViewAngle).stretches.size(), 1u);
}

// RELIEF-12.
TEST(SolveMotion, JoinsTwoClipsOfOneTissueByTheirFeatures) {
  CavityOptions options;
  options.frames = 24;
  options.two_clips = true;
  const Motion motion = SolvedFrom(options).motion;
  EXPECT_EQ(PosedFrames(motion.scene), options.frames);
  // Twice the error of one clip, since what joins them is a part of the points.
  EXPECT_LT(test::PathError(motion.scene.poses, test::CavityPoses(options)), 0.2e-3) << "m";
}

// RELIEF-12. Never one wrong.
TEST(SolveMotion, KeepsTwoClipsOfOtherTissueApart) {
  CavityOptions options;
  options.frames = 24;
  options.two_clips = options.elsewhere = true;
  const Motion motion = SolvedFrom(options).motion;
  EXPECT_EQ(PosedFrames(motion.scene), options.frames / 2);
  int others = 0;
  for (const MotionFrame& frame : motion.frames)
    others += frame.reason.find("belongs to part 2 of the clip") != std::string::npos;
  EXPECT_EQ(others, options.frames / 2);
}

}  // namespace
}  // namespace arthro::authoring
