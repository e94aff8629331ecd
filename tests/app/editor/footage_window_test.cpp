// From a clip to the backdrop in the window, by its users' hands: scripts that click by name.
#include <filesystem>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 7;  // number that the strip shows at once

// A clip of the phantom as pictures, and its lens; made once for all tests.
class FootageWindow : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    files = std::make_unique<test::TempFolder>();
    auto options = authoring::ClipOptionsOf(authoring::ClipPreset::kEasy, 400, 320);
    options.frames = kFrames;
    options.step = 0.25;
    const authoring::Clip made(options);
    fs::create_directory(*files / "clip");
    for (int i = 0; i < kFrames; ++i) {
      const cv::Mat frame = made.Frame(i);
      ColourImage picture(frame.cols, frame.rows);
      frame.copyTo(cv::Mat(frame.rows, frame.cols, CV_8UC3, picture.rgb.data()));
      WriteColourImage(*files / "clip" / ("frame" + std::to_string(i) + ".png"), picture);
    }
    WriteLens(*files / "scope.json", made.lens());
  }
  static void TearDownTestSuite() { files.reset(); }

  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = test::WriteSmallScene(temp / "knee");
  }
  // A failed script tells its line on stderr.
  void Drive(const std::string& script, const std::string& flags = "") {
    const auto result = test::RunWindow("edit " + scene.string() + " " + flags, script);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  static std::string Clip() { return (*files / "clip").string(); }
  static std::string Lens() { return (*files / "scope.json").string(); }

  inline static std::unique_ptr<test::TempFolder> files;
  test::TempFolder temp;
  fs::path scene;
};

TEST_F(FootageWindow, AClipBecomesTheBackdropOfASavedScene) {
  Drive("click \"Make one from a video…\"\nset \"File name\" " + Clip() +
        "\nclick \"Use this folder\"\nwait job\nexpect \"7 frames\"\n"
        "expect value \"Frame 0\" \"not yet\"\n"
        // Its lens, from a file.
        "click \"Lens of the scope\"\nclick \"from a file…\"\nset \"File name\" " +
        Lens() + "\nwait job\n" + R"(expect value "Lens of the scope" "scope"
click "Measure relief from motion"
click no
expect value "Measure relief from motion" no
click Rectified
wait job
expect not "nothing is straightened"
click Run
wait job
expect "7 of 7 frames placed"
expect "Expected error"
expect value "Frame 6" placed
expect disabled "Run again"
click "Use this panorama"
wait job
expect value Depth on
expect enabled Undo
click Save
wait job
expect "Saved in"
)");
  const LoadedScene saved = LoadScene(scene);
  const Projection& projection = saved.scene.backdrop.projection;
  EXPECT_EQ(projection.type, ProjectionType::kGnomonic);
  EXPECT_GT(projection.focal_px, 50);
  EXPECT_GT(saved.panorama->width, 300);
  EXPECT_EQ(saved.depth->width, saved.panorama->width);
}

TEST_F(FootageWindow, EveryPageLeadsToThePanoramaThatWasMadeAndNotUsed) {
  Drive(
      "click New\nexpect not \"Use this panorama\"\nclick Depth\nclick \"Take me there\"\n"
      "expect value Panorama on\nclick Exercises\nexpect not \"New exercise\"\n"
      "click \"Take me there\"\nclick \"Make one from a video…\"\nset \"File name\" " +
      Clip() + R"(
click "Use this folder"
wait job
click Run
wait job
click Practice
expect "There is no panorama yet."
expect enabled "Use this panorama"
click Exercises
expect enabled "Use this panorama"
click Tissue
click "Use this panorama"
wait job
expect value Depth on
expect enabled "Touch preview"
click Exercises
expect enabled "New exercise"
)");
}

TEST_F(FootageWindow, AFrameIsLeftOutAndTheRunGoesOnFromThere) {
  Drive("drop " + Clip() + R"(
wait job
click Run
wait job
expect "7 of 7 frames placed"
double-click "Frame 0"
expect value "Frame 0" "left out"
expect "The next run begins with placing the frames"
click "Use frame 0"
expect value "Frame 0" placed
expect disabled "Run again"
click "Frame 0"
key space
click "Run again"
wait job
expect "6 of 7 frames placed"
expect value "Frame 0" "left out"
)");
}

TEST_F(FootageWindow, ARunIsStoppedAndTheSceneStays) {
  // Long enough to be stopped: the clip there and back, many times.
  fs::create_directory(temp / "long");
  for (int i = 0; i < 120; ++i)
    fs::create_symlink(Clip() + "/frame" + std::to_string(i % kFrames) + ".png",
                       temp / "long" / ("frame" + std::to_string(i) + ".png"));
  Drive("drop " + (temp / "long").string() + R"(
wait job
click Run
expect Stop
click Stop
wait job
expect "Stopped."
expect "Small knee"
expect not "frames placed"
expect enabled "Run again"
click "Close it"
expect "Import a panorama…"
expect disabled Undo
)");
}

TEST_F(FootageWindow, FramesAreWalkedThroughByKeysAndLookedAtStepByStep) {
  Drive("drop " + Clip() + R"(
wait job
expect value "Frame number" "0"
key right
key right
expect value "Frame number" "2"
expect "Not looked at yet"
click "Even light"
wait job
expect "The run evens out the light"
wheel "Large picture" 3
key escape
expect "There is no panorama yet"
click Backdrop
expect "Read its report…"
click Footage
click Depth
expect "Red weight"
)");
}

TEST_F(FootageWindow, AClipOfOneFrameIsRefusedInASentence) {
  fs::create_directory(temp / "one");
  fs::copy(Clip() + "/frame0.png", temp / "one" / "frame0.png");
  Drive("drop " + (temp / "one").string() + R"(
wait job
expect "1 frame "
click Run
wait job
expect "needs two"
click OK
expect "Small knee"
)");
}

}  // namespace
}  // namespace arthro
