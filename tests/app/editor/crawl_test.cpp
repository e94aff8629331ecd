// A careless user: opens every page, list and dialog, moves every control to both ends and types
// nonsense (app/platform/script/crawler.h), in windows of all sizes. Dear ImGui's assertions are
// compiled into Debian's library, so that its abort is a failure here; the last line of what the
// program said is the action that it came from.
//   ARTHROSCENE_CRAWL_ACTIONS=2000 ARTHROSCENE_CRAWL_SEED=7: longer, or another way
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "authoring/project/document_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/measured_scene.h"
#include "tests/support/run_window.h"
#include "tests/support/shared_data.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

int NumberFrom(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr && *text != '\0' ? std::max(1, std::atoi(text)) : otherwise;
}

std::string LastLines(const std::string& text, std::size_t most = 1500) {
  return text.size() > most ? text.substr(text.size() - most) : text;
}

struct Size {
  int width, height;
};

class Crawl : public testing::Test {
 protected:
  void SetUp() override { ARTHRO_REQUIRE_XVFB(); }
  // `begin` leads to what is crawled; `actions` in all, shared by the sizes.
  void Drive(const std::string& arguments, const std::string& begin, std::vector<Size> sizes,
             int actions) {
    const int seed = NumberFrom("ARTHROSCENE_CRAWL_SEED", 1);
    const int all = NumberFrom("ARTHROSCENE_CRAWL_ACTIONS", actions);
    std::string script = begin;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      script += fmt::format("resize {} {}\nwait frames 3\ncrawl {} {}\n", sizes[i].width,
                            sizes[i].height, seed + static_cast<int>(i),
                            std::max(1, all / static_cast<int>(sizes.size())));
    std::printf("seed %d, %d actions\n", seed, all);
    const auto result = test::RunWindow(arguments, script, "2560x1600x24");
    EXPECT_EQ(result.exit_code, 0) << LastLines(result.err);
    EXPECT_EQ(result.err.find("ssertion"), std::string::npos) << LastLines(result.err);
    const auto told = result.err.rfind("crawl: ");
    if (told != std::string::npos) std::printf("%s", result.err.substr(told).c_str());
  }
  test::TempFolder temp;
};

TEST_F(Crawl, AnEmptyDocumentStandsAnything) {
  const fs::path scene = test::WriteSmallScene(temp / "knee");
  Drive("edit " + scene.string(), "key ctrl+n\n", {{800, 600}, {640, 480}}, 60);
}

TEST_F(Crawl, ASceneWithTissueStandsAnything) {
  const fs::path scene = test::WriteSmallScene(temp / "knee");
  Drive("edit " + scene.string(), "", {{1024, 700}, {320, 240}, {800, 600}}, 120);
}

TEST_F(Crawl, TheMapOfAMeasuredDepthStandsAnything) {
  authoring::SaveDocument(test::MeasuredDocument(), temp / "scene");
  Drive("edit " + (temp / "scene").string(), "key f7\nclick \"Map of the depth\"\n",
        {{1024, 700}, {320, 240}, {640, 480}}, 90);
}

TEST_F(Crawl, TheDemoSceneStandsAnything) {
  fs::copy(fs::path(ARTHRO_SOURCE_DIR) / "resources" / "demo", temp / "demo",
           fs::copy_options::recursive);
  Drive("edit " + (temp / "demo").string(), "", {{800, 600}, {2560, 1600}}, 40);
}

TEST_F(Crawl, PracticeStandsAnything) {
  const fs::path scene = test::WriteSmallScene(temp / "knee");
  Drive("practise " + scene.string(), "wait job\n", {{800, 600}, {320, 240}}, 70);
}

TEST_F(Crawl, EveryWindowStandsEverySize) {
  const fs::path scene = test::WriteSmallScene(temp / "knee");
  const std::vector<Size> sizes = {{1, 1},     {2, 2},       {1, 800},   {1280, 1}, {24, 24},
                                   {320, 240}, {2560, 1600}, {640, 480}, {3, 200}};
  Drive("edit --size 1x1 " + scene.string(), "", sizes, 18);
  std::string script;
  for (const char* page : {"key f6", "key f7", "key f8", "key f9", "key f10", "key f1"}) {
    script += fmt::format("{}\n", page);
    for (const Size& size : sizes)
      script += fmt::format("resize {} {}\nwait frames 2\n", size.width, size.height);
  }
  const auto result = test::RunWindow("edit --size 2x2 " + scene.string(), script, "2560x1600x24");
  EXPECT_EQ(result.exit_code, 0) << LastLines(result.err);
}

// The seed of the random sequence ranges over all of int, half of which is ImGui's limit for
// sliders.
TEST_F(Crawl, EveryOptionOfTheFootagePageIsShownAndTakesBothEnds) {
  const fs::path frames = temp / "frames";
  fs::create_directory(frames);
  const fs::path scene = test::WriteSmallScene(temp / "knee");
  for (int i = 0; i < 3; ++i)
    fs::copy_file(scene / "panorama.png", frames / fmt::format("{:04}.png", i));
  Drive("edit " + scene.string(),
        "drop " + frames.string() +
            "\nwait job\nexpect \"Lens of the scope\"\nresize 1280 8000\nwait frames 3\n"
            "click \"More options\"\nwait frames 2\n"
            "expect \"Start of the random numbers\"\n"
            "set \"Start of the random numbers\" 2147483647\n"
            "expect value \"Start of the random numbers\" 2147483647\n"
            "set \"Start of the random numbers\" -7\n"
            "expect value \"Start of the random numbers\" 0\n",
        {{1280, 800}, {640, 480}}, 90);
}

TEST_F(Crawl, ASceneOfRealFootageStandsAnything) {
  ARTHRO_REQUIRE_SHARED(clip, "data/laparoscopy_rvim/endo.mp4");
  cv::VideoCapture capture(clip.string());
  cv::Mat frame;
  for (int i = 0; i <= 60; ++i) ASSERT_TRUE(capture.read(frame)) << clip;
  fs::create_directory(temp / "real");
  ASSERT_TRUE(cv::imwrite((temp / "real" / "frame.png").string(), frame));
  // 60 degrees across, 50 mm away: what a mosaic of this scope would be laid out as.
  std::ofstream(temp / "real" / "scene.json")
      << R"({"schema": "arthroscene.scene/1", "title": "Real frame",
    "backdrop": {"panorama": "frame.png", "radius": 0.05,
      "projection": {"type": "gnomonic", "centre_px": [639.5, 359.5], "focal_px": 900}},
    "scope": {"view_angle_deg": 0, "field_of_view_deg": 60}})";
  Drive("edit " + (temp / "real").string(), "drop " + clip.string() + "\nwait frames 20\n",
        {{800, 600}, {640, 480}}, 40);
}

}  // namespace
}  // namespace arthro
