// The job `view`, run as a user runs it, without a display.
#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/run_program.h"

namespace arthro::test {
namespace {

// The scene of the other tests, as files.
std::string WriteViewScene(const TempFolder& folder) {
  const LoadedScene loaded = MakeViewScene();
  WriteColourImage(folder / "panorama.png", *loaded.panorama);
  WriteDepthMap(folder / "depth.tiff", *loaded.depth);
  WriteSurface(folder / "ring.ply", *loaded.surfaces[0]);
  WriteScene(folder / "scene.json", loaded.scene);
  return folder.path().string();
}

constexpr const char* kNoDisplay = "env -u DISPLAY -u WAYLAND_DISPLAY";
constexpr const char* kPose =
    " --latitude-deg -7 --longitude-deg 3 --roll-deg 12 --insertion-mm 8 --view-angle-deg 30";

class ViewJob : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      app::OffscreenContext context;
    } catch (const Error& error) {
      GTEST_SKIP() << "NOT TESTED, NOTHING WAS DRAWN: " << error.what();
    }
  }
  TempFolder folder_;
  const std::string scene_ = WriteViewScene(folder_);
};

TEST_F(ViewJob, DrawsWithoutADisplayAndTheSameBytesEachTime) {
  for (const char* name : {"a.png", "b.png"}) {
    const ProgramResult run = RunProgram(
        "view " + scene_ + kPose + " --size 160 -o " + (folder_ / name).string(), kNoDisplay);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
  }
  const ColourImage first = ReadColourImage(folder_ / "a.png");
  EXPECT_EQ(first.width, 160);
  EXPECT_EQ(first.height, 160);
  EXPECT_EQ(first.rgb, ReadColourImage(folder_ / "b.png").rgb);
}

TEST_F(ViewJob, DrawsTheSamePictureAsTheView) {
  const ProgramResult run =
      RunProgram("view " + scene_ + kPose +
                     " --plain --field-of-view-deg 100 --head-roll-deg 40 --size 128 -o " +
                     (folder_ / "p.png").string(),
                 kNoDisplay);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  app::StillPictures pictures(LoadScene(scene_));
  constexpr double kDeg = std::numbers::pi / 180;
  app::Picture picture = app::PictureFromPose({-7 * kDeg, 3 * kDeg, 12 * kDeg, 0.008}, 30 * kDeg,
                                              100 * kDeg, 40 * kDeg);
  picture.plain = true;
  EXPECT_EQ(ReadColourImage(folder_ / "p.png").rgb, pictures.Draw(picture, 128).rgb);
}

TEST_F(ViewJob, AppliesTheGivenDisturbances) {
  const auto drawn = [&](const std::string& options) {
    const std::string file = (folder_ / "d.png").string();
    const ProgramResult run =
        RunProgram("view " + scene_ + kPose + " --size 96 " + options + " -o " + file, kNoDisplay);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return ReadColourImage(file).rgb;
  };
  const auto clear = drawn(""), hazy = drawn("--disturb haze=0.6,debris=1");
  EXPECT_NE(hazy, clear);
  EXPECT_EQ(drawn("--disturb haze=0.6,debris=1 --disturb-seed 0 --disturb-time 0"), hazy);
  EXPECT_NE(drawn("--disturb haze=0.6,debris=1 --disturb-seed 2"), hazy);
  EXPECT_NE(drawn("--disturb haze=0.6,debris=1 --disturb-time 2"), hazy);
  EXPECT_EQ(drawn("--disturb haze=0 --disturb-time 2"), clear);
  // Flecks drift in saline alone.
  Scene scene = MakeViewScene().scene;
  scene.backdrop.medium = Medium::kSaline;
  WriteScene(folder_ / "scene.json", scene);
  EXPECT_NE(drawn("--no-camera --no-flecks"), drawn("--no-camera"));
}

// Without a depth map the range of the lamp's light is unknown.
TEST_F(ViewJob, WithoutADepthMapTheFootageKeepsItsOwnLight) {
  const auto drawn = [&](const std::string& options) {
    const std::string file = (folder_ / "l.png").string();
    const ProgramResult run =
        RunProgram("view " + scene_ + kPose + " --size 96 " + options + " -o " + file, kNoDisplay);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return ReadColourImage(file).rgb;
  };
  EXPECT_NE(drawn("--relight 1"), drawn("--relight 0"));
  Scene scene = MakeViewScene().scene;
  scene.backdrop.depth.clear();
  WriteScene(folder_ / "scene.json", scene);
  EXPECT_EQ(drawn("--relight 1"), drawn("--relight 0"));
}

// Kinds of pictures that other programs write: grey, 16 bits, with alpha, and a single pixel.
TEST_F(ViewJob, ReadsEveryKindOfPanorama) {
  const auto drawn = [&] {
    const std::string file = (folder_ / "k.png").string();
    const ProgramResult run =
        RunProgram("view " + scene_ + kPose + " --plain --size 96 -o " + file, kNoDisplay);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return ReadColourImage(file).rgb;
  };
  const std::string file = (folder_ / "panorama.png").string();
  const cv::Mat bgr = cv::imread(file, cv::IMREAD_COLOR);
  const auto colours = drawn();
  cv::Mat deep, clear, grey;
  bgr.convertTo(deep, CV_16UC3, 257.0);
  cv::imwrite(file, deep);
  EXPECT_EQ(drawn(), colours) << "16 bits";
  cv::cvtColor(bgr, clear, cv::COLOR_BGR2BGRA);
  cv::insertChannel(cv::Mat(bgr.size(), CV_8UC1, cv::Scalar(99)), clear, 3);
  cv::imwrite(file, clear);
  EXPECT_EQ(drawn(), colours) << "alpha says nothing";
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  for (const bool is_deep : {false, true}) {
    if (is_deep) grey.convertTo(grey, CV_16UC1, 257.0);
    cv::imwrite(file, grey);
    const auto greys = drawn();
    int coloured = 0, seen = 0;
    for (std::size_t i = 0; i < greys.size(); i += 3) {
      coloured += greys[i] != greys[i + 1] || greys[i] != greys[i + 2];
      seen += greys[i] > 0;
    }
    EXPECT_EQ(coloured, 0);
    EXPECT_GT(seen, 4000);
  }
  Scene scene = MakeViewScene().scene;
  scene.backdrop.depth.clear();
  scene.backdrop.projection.centre_px = {0, 0};
  WriteScene(folder_ / "scene.json", scene);
  cv::imwrite(file, cv::Mat(1, 1, CV_8UC3, cv::Scalar(40, 80, 160)));
  drawn();
}

// A sentence and a picture.
TEST_F(ViewJob, ATissueOfAnUnknownPresetIsDrawnWithoutStructure) {
  LoadedScene loaded = MakeViewScene();
  loaded.scene.tissues[0].material = "no-such-preset";
  WriteScene(folder_ / "scene.json", loaded.scene);
  const ProgramResult run = RunProgram(
      "view " + scene_ + kPose + " --size 96 -o " + (folder_ / "p.png").string(), kNoDisplay);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "note: there is no preset no-such-preset; ring is drawn without structure\n");
  EXPECT_EQ(ReadColourImage(folder_ / "p.png").width, 96);
}

TEST_F(ViewJob, DrawsAPanoramaOfOnePixel) {
  Scene scene = MakeViewScene(16, 16).scene;
  scene.tissues.clear();
  scene.backdrop.projection.centre_px = {0, 0};
  scene.backdrop.projection.focal_px = 1;
  ColourImage pixel(1, 1);
  std::copy_n(std::array<std::uint8_t, 3>{180, 120, 100}.data(), 3, pixel.at(0, 0));
  WriteColourImage(folder_ / "panorama.png", pixel);
  for (const bool has_depth : {false, true}) {
    scene.backdrop.depth = has_depth ? "depth.tiff" : "";
    WriteDepthMap(folder_ / "depth.tiff", DepthMap(1, 1, 0.004f));
    for (const double relight : {0.0, 1.0}) {
      scene.backdrop.relight = relight;
      WriteScene(folder_ / "scene.json", scene);
      const ProgramResult run = RunProgram(
          "view " + scene_ + " --view-angle-deg 0 --size 96 -o " + (folder_ / "p.png").string(),
          kNoDisplay);
      EXPECT_EQ(run.exit_code, 0) << run.err;
      // The pixel fills some 50 degrees in the middle of the window.
      const ColourImage picture = ReadColourImage(folder_ / "p.png");
      EXPECT_GT(picture.at(48, 48)[0], 40) << has_depth << relight;
    }
  }
}

// Outlines of noise would be all over the picture.
TEST_F(ViewJob, DrawsADepthMapThatIsAllNoise) {
  LoadedScene loaded = MakeViewScene();
  loaded.scene.tissues.clear();
  DepthMap noise(loaded.panorama->width, loaded.panorama->height);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> height(0.0f, 0.02f);
  for (int y = 0; y < noise.height; ++y)
    for (int x = 0; x < noise.width; ++x) noise.at(x, y) = height(random);
  WriteDepthMap(folder_ / "depth.tiff", noise);
  loaded.scene.backdrop.relight = 1;
  WriteScene(folder_ / "scene.json", loaded.scene);
  const ProgramResult check = RunProgram("check " + scene_, kNoDisplay);
  EXPECT_NE((check.out + check.err).find("outlines are not drawn"), std::string::npos)
      << check.out << check.err;
  const ProgramResult run = RunProgram(
      "view " + scene_ + kPose + " --no-camera --size 256 -o " + (folder_ / "p.png").string(),
      kNoDisplay);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // The colours vary slowly; outlines of noise would be steps between neighbours.
  const ColourImage picture = ReadColourImage(folder_ / "p.png");
  int steps = 0, count = 0;
  for (int y = 64; y < 192; ++y)
    for (int x = 64; x < 192; ++x, ++count)
      steps += std::abs(int(picture.at(x + 1, y)[1]) - int(picture.at(x, y)[1])) > 12 ? 1 : 0;
  std::printf("steps between neighbours: %.2f %%\n", 100.0 * steps / count);
  EXPECT_LE(steps, 0.01 * count);
}

TEST_F(ViewJob, RefusesInvalidInputAndWritesNothing) {
  const std::string output = (folder_ / "none.png").string();
  const auto refuse = [&](const std::string& arguments, int code, const std::string& word) {
    const ProgramResult run = RunProgram("view " + arguments + " -o " + output, kNoDisplay);
    EXPECT_EQ(run.exit_code, code) << arguments;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(output)) << arguments;
  };
  refuse(scene_ + " --insertion-mm 60", 1, "50.0 mm");
  refuse(scene_ + " --roll-deg nan", 2, "--roll-deg");
  refuse(scene_ + " --insertion-mm nan", 2, "insert");
  refuse(scene_ + " --relight nan", 2, "--relight");
  refuse(scene_ + " --relight 1.5", 2, "--relight");
  refuse(scene_ + " --view-angle-deg 120", 2, "view-angle-deg");
  refuse(scene_ + " --disturb smoke=1", 1, "there are haze, bubbles, debris, fog");
  refuse(scene_ + " --disturb haze=7", 1, "between 0 and 1");
  refuse(scene_ + " --disturb haze=nan", 1, "between 0 and 1");
  refuse(scene_ + " --disturb haze=-1", 1, "between 0 and 1");
  refuse(scene_ + " --disturb haze=1 --disturb-time nan", 2, "--disturb-time");
  refuse(scene_ + " --size 0", 2, "size");
  refuse((folder_ / "absent").string(), 1, "absent");
}

TEST_F(ViewJob, ReportsMissingOpenGLInOneSentence) {
  const ProgramResult run =
      RunProgram("view " + scene_ + " -o " + (folder_ / "x.png").string(),
                 std::string(kNoDisplay) + " __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no picture can be drawn"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST_F(ViewJob, ReportsAnOldOpenGLInOneSentence) {
  const std::string view = "view " + scene_ + " -o " + (folder_ / "x.png").string();
  const ProgramResult run = RunProgram(
      view, std::string(kNoDisplay) + " LIBGL_ALWAYS_SOFTWARE=1 MESA_GL_VERSION_OVERRIDE=2.1");
  if (run.exit_code == 0) GTEST_SKIP() << "NOT TESTED: this is not Mesa's OpenGL";
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no OpenGL 3.2"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

}  // namespace
}  // namespace arthro::test
