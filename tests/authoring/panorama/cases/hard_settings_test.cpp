// Hard cases PAN-09 to PAN-18, LENS-01: effects of the lens, the camera and the path on a clip.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/footage/footage.h"
#include "authoring/panorama/clip/footage_lens.h"
#include "authoring/panorama/graph/place_frames.h"
#include "tests/authoring/panorama/cases/case_run.h"
#include "tests/authoring/panorama/graph/simulated_clip.h"

namespace arthro::test {
namespace {

using namespace arthro::authoring;

// Three rows over the plane and pairs of them with 0.2 px of noise, without pictures, which allows
// 300 frames.
PlacedGraph PlaceRows(int frames, std::vector<cv::Matx33d>& truth) {
  const int a_row = frames / 3;
  for (int i = 0; i < frames; ++i) {
    const int row = std::min(i / a_row, 2), along = i - row * a_row;
    truth.push_back(PlaceOver(45.0 * (row % 2 == 0 ? along : a_row - along), 250.0 * row, kFocal,
                              0.05 * std::sin(0.2 * i), 0.05 * std::cos(0.13 * i),
                              0.2 * std::sin(0.1 * i)));
  }
  FrameWindow window = WindowOf({800, 800, kFocal, kCentre, kCentre}, cv::Mat());
  window.radius = kRadius;
  const PairMaker maker = [&](const PairRequest& request,
                              std::string* why_not) -> std::optional<PairEstimate> {
    const double overlap = OverlapOf(window, truth[static_cast<std::size_t>(request.b)].inv() *
                                                 truth[static_cast<std::size_t>(request.a)]);
    if (overlap < 0.2) {
      *why_not = "the frames do not look alike";
      return std::nullopt;
    }
    std::mt19937 random(static_cast<unsigned>(1000 * request.a + request.b));
    PairEstimate pair = NoisyPair(truth, request.a, request.b, 0.2, random);
    pair.overlap = overlap;
    return pair;
  };
  return PlaceFrames(std::vector<std::string>(static_cast<std::size_t>(frames)), maker, window,
                     Pinhole{kFocal, kCentre, kCentre}, {}, {}, {}, 1, {});
}

TEST(HardCase09, AFrameCostsNoMoreInALongClip) {
  std::vector<cv::Matx33d> truth_of_40, truth_of_300;
  const PlacedGraph of_40 = PlaceRows(40, truth_of_40);
  const PlacedGraph of_300 = PlaceRows(300, truth_of_300);
  const std::vector<double> errors = WorstErrors(of_300.plane_from_frame, truth_of_300);
  const double worst = *std::max_element(errors.begin(), errors.end());
  const double growth = (of_300.tried / 300.0) / (of_40.tried / 40.0);
  std::printf(
      "pairs tried a frame: %.2f of 40, %.2f of 300 (x %.2f); refinement %.2f and %.2f CPU ms a "
      "frame; worst of 300 frames %.2f px\n",
      of_40.tried / 40.0, of_300.tried / 300.0, growth, of_40.refine_ms / 40,
      of_300.refine_ms / 300, worst);
  RecordProperty("growth", std::to_string(growth));
  RecordProperty("worst_px", std::to_string(worst));
  EXPECT_LE(growth, 1.3);  // pairs determine the cost of a frame
  EXPECT_LE(worst, 3.0);
}

CaseRun RunWrongLens(const Clip& clip, double focal_factor, double off_centre_px) {
  CaseSetting setting;
  setting.believed = clip.lens();
  setting.believed->focal_px *= focal_factor;
  setting.believed->cx += off_centre_px;
  return RunCase(clip, setting);
}

TEST(HardCase10, AFocalLength5PercentOffIsWarnedOf) {
  const Clip clip(CaseOptions(ClipPreset::kEasy, 14));
  const CaseRun right = RunWrongLens(clip, 1, 0);
  Tell("focal right", right);
  EXPECT_TRUE(right.report.warnings.empty());
  for (const double factor : {0.95, 1.05}) {
    const CaseRun run = RunWrongLens(clip, factor, 0);
    Tell(factor < 1 ? "focal -5 %" : "focal +5 %", run);
    EXPECT_EQ(run.Score().right, clip.frames());
    EXPECT_EQ(run.Score().wrong_as_good, 0);
    // Also required: the focal length to 1 %. Registration names it as the likely cause and leaves
    // the correction to calibration.
    ASSERT_FALSE(run.report.warnings.empty());
    EXPECT_NE(run.report.warnings[0].find("focal length"), std::string::npos);
  }
}

// Loops close in spite of the error, so registration has no sign of it; the frames stay right.
TEST(HardCase10, ACentre20PxOffKeepsEveryFrameRight) {
  const Clip clip(CaseOptions(ClipPreset::kEasy, 14));
  const CaseRun run = RunWrongLens(clip, 1, 10);  // 20 px of 800 x 640
  Tell("centre 20 px", run);
  EXPECT_EQ(run.Score().right, clip.frames());
  EXPECT_EQ(run.Score().wrong_as_good, 0);
}

// The footage itself reveals the error: its round window is not at the lens's position.
TEST(HardCase10, ACentre20PxOffIsWarnedOfByTheRoundWindow) {
  const Clip clip(CaseOptions(ClipPreset::kEasy, 3));
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "hard_case_10_centre";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  for (int i = 0; i < clip.frames(); ++i) {
    cv::Mat bgr;
    cv::cvtColor(clip.Frame(i), bgr, cv::COLOR_RGB2BGR);
    ASSERT_TRUE(cv::imwrite(folder / (std::to_string(i) + ".png"), bgr));
  }
  Footage footage = Footage::Open(folder);
  EXPECT_TRUE(LensOf(footage, clip.lens(), {}).warnings.empty());
  Lens shifted = clip.lens();
  shifted.cx += 10;  // 20 px of 800 x 640
  shifted.circle.cx += 10;
  const auto warnings = LensOf(footage, shifted, {}).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("round window"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(HardCase14, MarksAndRimThatStayDoNotHoldTheFramesStill) {
  ClipOptions options = CaseOptions(ClipPreset::kFaint, 14);
  options.contrast = 0.3;
  options.marks = true;
  const CaseRun run = RunCase(options);
  Tell("marks", run);
  EXPECT_EQ(run.Score().right, options.frames);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
}

TEST(HardCase16, HalfATurnDuringTheSweep) {
  ClipOptions options = CaseOptions(ClipPreset::kEasy, 16);
  options.roll_sweep = CV_PI;
  const CaseRun run = RunCase(options);
  Tell("roll", run);
  EXPECT_GE(run.Score().right, 0.9 * options.frames);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
}

TEST(HardCase16, ZoomByTwoDuringTheSweep) {
  ClipOptions options = CaseOptions(ClipPreset::kEasy, 14);
  options.zoom_sweep = 2;
  const CaseRun run = RunCase(options);
  Tell("zoom", run);
  EXPECT_GE(run.Score().right, 0.9 * options.frames);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
}

// Nine points of every frame, after the best single homography between the two panoramas.
TEST(HardCase17, ExposureAndGammaLeaveTheGeometry) {
  const ClipOptions usual = CaseOptions(ClipPreset::kEasy, 10);
  const CaseRun reference = RunCase(usual);
  Tell("gamma 1.6", reference);
  const struct {
    const char* name;
    double gamma, exposure_step;
  } cameras[] = {{"gamma 1.0", 1.0, 1}, {"gamma 2.4", 2.4, 1}, {"exposure / 4", 1.6, 0.25}};
  for (const auto& camera : cameras) {
    ClipOptions options = usual;
    options.gamma = camera.gamma;
    options.exposure_step = camera.exposure_step;
    const CaseRun run = RunCase(options);
    Tell(camera.name, run);
    const ClipScore apart = run.Against(reference);
    std::printf("    from gamma 1.6: mean %.3f max %.3f px\n", apart.mean_px, apart.max_px);
    RecordProperty("apart_px", std::to_string(apart.max_px));
    EXPECT_EQ(apart.right, options.frames);
    EXPECT_LE(apart.max_px, 0.2) << camera.name;
  }
}

TEST(HardCase18, RepeatedTextureMakesNoFalseLoops) {
  ClipOptions options = CaseOptions(ClipPreset::kEasy, 16);
  options.repeated = true;
  const CaseRun run = RunCase(options);
  Tell("repeated", run);
  EXPECT_LE(run.Score().mean_px, 2.0);
  EXPECT_EQ(run.Score().right, options.frames);
  EXPECT_EQ(run.Score().wrong_as_good, 0);
}

}  // namespace
}  // namespace arthro::test
