#include "app/bench/relief/colmap_peer.h"

#include <filesystem>
#include <fstream>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/support/relief/cavity_clip.h"
#include "tests/support/relief/pose_score.h"
#include "tests/support/relief/surface_score.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 4, kWithout = 2;

// A program that answers like COLMAP: two models, the larger one with the true poses of all frames
// but one, in another frame and scale.
fs::path FakeColmap(const test::TempFolder& folder, const std::vector<authoring::CameraPose>& poses,
                    const Eigen::Matrix3d& turn, double scale) {
  std::ofstream images(folder / "images.txt");
  images << "# Image list with two lines of data per image:\n";
  for (int i = 0; i < kFrames; ++i) {
    if (i == kWithout) continue;
    const authoring::CameraPose& pose = poses[static_cast<std::size_t>(i)];
    const Eigen::Matrix3d camera_from_world = (turn * pose.world_from_camera).transpose();
    const Eigen::Quaterniond q(camera_from_world);
    const Eigen::Vector3d shift = -camera_from_world * (scale * (turn * pose.centre));
    images << i + 1 << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' '
           << shift.x() << ' ' << shift.y() << ' ' << shift.z() << " 1 00" << i << ".png\n\n";
  }
  const Eigen::Vector3d point =
      scale * (turn * Eigen::Vector3d(0, 0, test::CavityRadius({0, 0, 1})));
  std::ofstream(folder / "points3D.txt") << "# 3D point list\n7 " << point.x() << ' ' << point.y()
                                         << ' ' << point.z() << " 10 20 30 0.4 1 5 2 8\n";
  const fs::path program = folder / "colmap";
  std::ofstream(program) << "#!/bin/sh\ncd '" << folder.path().string() << "'\n"
                         << R"(while [ $# -gt 1 ]; do
  case "$1" in
    mapper) job=mapper ;;
    model_converter) job=convert ;;
    --output_path) out="$2" ;;
    --input_path) in="$2" ;;
  esac
  shift
done
case "$job" in
  mapper) mkdir "$out/0" "$out/1" ;;
  convert)
    if [ "${in##*/}" = 1 ]; then cp points3D.txt "$out"; cp images.txt "$out"
    else : > "$out/images.txt"; : > "$out/points3D.txt"; fi ;;
esac
)";
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

TEST(ColmapPeer, ReadsPosesAndPointsOfTheLargestModel) {
  const test::TempFolder folder, clip;
  test::CavityOptions options;
  options.frames = kFrames;
  test::WriteCavityClip(clip.path(), options);
  const test::CavityTruth truth = test::TruthOf(options);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const fs::path program = FakeColmap(folder, truth.poses, turn, 170);
  const ColmapModel model = RunColmap(program, clip.path(), truth.lens, {});
  EXPECT_EQ(model.outcome, "done");
  ASSERT_EQ(model.frames.size(), kFrames - 1u);
  authoring::ReliefReport report;
  report.frames = model.frames;
  const test::PoseScore score = test::ScorePoses(report, truth);
  EXPECT_LT(score.path, 1e-6) << "six digits of the text";
  EXPECT_LT(score.rotation, 1e-3) << "rad; arc cosine near one of six digits";
  // The point lies on the surface, straight ahead of the portal.
  const auto fit = test::FitCameras(model.frames, truth.poses);
  ASSERT_TRUE(fit && model.points.size() == 1);
  const test::TrueSurface surface = test::SurfaceOf(truth);
  const test::FoundSurface found = test::SurfaceOf(model.points, *fit, surface);
  const int middle = surface.radius.width / 2;
  EXPECT_NEAR(found.radius.at(middle, middle), test::CavityRadius({0, 0, 1}), 1e-6);
}

TEST(ColmapPeer, SaysWhichStepFailed) {
  const test::TempFolder folder;
  std::ofstream(folder / "colmap") << "#!/bin/sh\nexit 1\n";
  fs::permissions(folder / "colmap", fs::perms::owner_all);
  const ColmapModel model = RunColmap(folder / "colmap", folder.path(), test::CavityLens(), {});
  EXPECT_EQ(model.outcome, "feature_extractor failed");
  EXPECT_TRUE(model.frames.empty());
}

TEST(FindProgram, LooksInEveryFolderOfThePath) {
  const test::TempFolder empty, folder;
  std::ofstream(folder / "colmap") << "#!/bin/sh\n";
  const std::string path = empty.path().string() + ":" + folder.path().string();
  EXPECT_FALSE(FindProgram("colmap", path)) << "a file that cannot be executed";
  fs::permissions(folder / "colmap", fs::perms::owner_all);
  EXPECT_EQ(FindProgram("colmap", path), folder / "colmap");
  EXPECT_FALSE(FindProgram("colmap", ""));
}

}  // namespace
}  // namespace arthro::app
