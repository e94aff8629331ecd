// Poses, portal and verdicts from tracks with known truth, without pictures.
#include "authoring/relief/motion/motion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "authoring/relief/make/verdict.h"
#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/motion/portal.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::authoring {
namespace {

using test::CavityOptions;
using test::ScopeMotion;

Motion MotionOf(const CavityOptions& options) {
  std::vector<Track> tracks = test::CavityTracks(options);
  return SolveMotion(tracks, options.frames, LensProfile(test::CavityLens()), {});
}

int Posed(const Motion& motion) {
  return static_cast<int>(std::count_if(motion.scene.poses.begin(), motion.scene.poses.end(),
                                        [](const auto& pose) { return pose.has_value(); }));
}

TEST(LensProfile, AgreesWithEveryLensModelToAThousandthOfAPixel) {
  for (const LensModel model : {LensModel::kEquisolid, LensModel::kKannalaBrandt,
                                LensModel::kDoubleSphere, LensModel::kPinhole}) {
    Lens lens = test::CavityLens();
    lens.model = model;
    lens.aspect = 1.02;
    lens.k = model == LensModel::kDoubleSphere ? std::array<double, 4>{0.1, 0.55, 0, 0}
                                               : std::array<double, 4>{-0.04, 0.001, 0, 0};
    const LensProfile profile(lens);
    for (double angle = 0; angle < 0.9; angle += 0.01) {
      const glm::dvec3 ray(std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle));
      const glm::dvec2 truth = *PixelFromRay(lens, ray);
      const double point[3] = {3 * ray.x, 3 * ray.y, 3 * ray.z};
      double pixel[2];
      profile.Project(point, pixel);
      EXPECT_NEAR(pixel[0], truth.x, 1e-3);
      EXPECT_NEAR(pixel[1], truth.y, 1e-3);
    }
  }
}

TEST(SolveMotion, PosesEveryFrameThroughNoiseAndOutliers) {
  const CavityOptions options;
  const Motion motion = MotionOf(options);
  EXPECT_EQ(Posed(motion), options.frames);
  EXPECT_TRUE(JudgeMotion(motion).is_measured()) << JudgeMotion(motion).sentence;
  // The goal is 0.05 mm for clips with a focal length of 248 px at the axis; this lens has 125 px,
  // so that the same error in pixels is twice as long.
  constexpr double kGoal = 0.05e-3, kGoalFocal = 248;  // m, px
  const double limit = kGoal * kGoalFocal / LensProfile(test::CavityLens()).focal_px();
  const double error = test::PathError(motion.scene.poses, test::CavityPoses(options));
  EXPECT_LT(error, limit) << "m";
}

TEST(FindPivot, PutsThePortalWhereTheShaftsMeet) {
  for (const double head_turn : {0.0, 1.2}) {
    CavityOptions options;
    options.head_turn = head_turn;
    std::vector<std::optional<CameraPose>> poses;
    const Eigen::Vector3d portal(0.01, -0.02, 0.03);
    for (CameraPose pose : test::CavityPoses(options)) {
      pose.centre += portal;
      poses.emplace_back(pose);
    }
    const PivotFit fit = FindPivot(poses, test::kViewAngle);
    EXPECT_NEAR(fit.head_turns.front(), head_turn, 0.005)
        << "the search ends in steps of a quarter degree";
    if (head_turn == 0) {
      EXPECT_LT((fit.stretches.front().point - portal).norm(), 1e-9);
      EXPECT_LT(fit.median_miss, 1e-9);
    }
    EXPECT_GT(fit.median_insertion, 0.01);
  }
}

TEST(SolveMotion, IsTheSameEachTime) {
  CavityOptions options;
  options.frames = 8;
  const Motion a = MotionOf(options), b = MotionOf(options);
  ASSERT_EQ(a.scene.points.size(), b.scene.points.size());
  for (std::size_t i = 0; i < a.scene.poses.size(); ++i) {
    ASSERT_EQ(a.scene.poses[i].has_value(), b.scene.poses[i].has_value());
    if (a.scene.poses[i]) {
      EXPECT_EQ(a.scene.poses[i]->centre, b.scene.poses[i]->centre);
    }
  }
}

// RELIEF-01.
TEST(JudgeMotion, CallsRollingAboutTheTipARotationOnly) {
  CavityOptions options;
  options.motion = ScopeMotion::kRoll;
  EXPECT_EQ(JudgeMotion(MotionOf(options)).kind, "rotation_only");
}

// RELIEF-13.
TEST(JudgeMotion, CallsEqualFramesStill) {
  CavityOptions options;
  options.motion = ScopeMotion::kStill;
  options.noise_px = 0.05;
  options.outliers = 0;
  const Motion motion = MotionOf(options);
  EXPECT_EQ(JudgeMotion(motion).kind, "still");
  for (const auto& pose : motion.scene.poses) {
    if (pose) {
      EXPECT_TRUE(pose->centre.allFinite());
    }
  }
}

TEST(JudgePivot, RefusesShaftsThatTurnWidelyAndDoNotMeet) {
  EXPECT_EQ(JudgePivot(0.26, 0.35).kind, "pivot");
  EXPECT_TRUE(JudgePivot(0.04, 0.35).is_measured());
  EXPECT_TRUE(JudgePivot(0.26, 0.01).is_measured()) << "insertion alone does not place the portal";
}

TEST(JudgeMotion, RefusesAClipThatTwoPathsExplain) {
  Motion motion = MotionOf({});
  EXPECT_TRUE(JudgeMotion(motion).is_measured());
  EXPECT_EQ(motion.start_difference, 0) << "one start explains all frames";
  motion.start_difference = 0.11;
  EXPECT_EQ(JudgeMotion(motion).kind, "ambiguous");
}

// RELIEF-18.
TEST(JudgeTool, NamesAnInstrumentThatHidesMuchOfARefusedClip) {
  const std::vector<double> much{0.05, 0.3, 0.25, 0.4}, little{0.3, 0.05, 0.02, 0.1};
  const ReliefVerdict pieces{"pieces", "few frames join", "share", 0.3, 0.5};
  const ReliefVerdict tool = JudgeTool(pieces, much);
  EXPECT_EQ(tool.kind, "tool");
  EXPECT_EQ(tool.value, 0.3);
  EXPECT_NE(tool.sentence.find("30 % of the picture"), std::string::npos) << tool.sentence;
  EXPECT_EQ(JudgeTool(pieces, little).kind, "pieces");
  EXPECT_TRUE(JudgeTool({}, much).is_measured()) << "right beside the instrument";
  EXPECT_EQ(JudgeTool({"rotation_only", "", "", 0, 1}, much).kind, "rotation_only")
      << "the instrument is not the reason";
}

TEST(JudgeMotion, NamesMissingTexture) {
  CavityOptions options;
  options.points = 30;
  const ReliefVerdict verdict = JudgeMotion(MotionOf(options));
  EXPECT_EQ(verdict.kind, "texture");
  EXPECT_LT(verdict.value, verdict.limit);
}

}  // namespace
}  // namespace arthro::authoring
