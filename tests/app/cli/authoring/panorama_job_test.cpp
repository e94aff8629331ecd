#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/authoring/panorama/tiny_clip.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_program.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using test::TinyClip;

class PanoramaJob : public ::testing::Test {
 protected:
  void SetUp() override { TinyClip().WriteAll(folder_ / "clip", TinyClip::Arc(4)); }

  test::ProgramResult Run(const std::string& footage, const std::string& flags,
                          const std::string& output = "p.png") {
    return test::RunProgram("panorama " + (folder_ / footage).string() + " -o " +
                            (folder_ / output).string() + " " + flags);
  }

  test::TempFolder folder_;
};

TEST_F(PanoramaJob, WritesPictureAndReport) {
  const auto result = Run("clip", "--report " + (folder_ / "r.json").string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("all 4 usable frames"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("is a guess"), std::string::npos) << result.err;
  const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "r.json"));
  const ColourImage picture = ReadColourImage(folder_ / "p.png");
  EXPECT_EQ(report.at("panorama").at("width"), picture.width);
  EXPECT_EQ(report.at("panorama").at("height"), picture.height);
  EXPECT_EQ(report.at("frames").size(), 4u);
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
}

TEST_F(PanoramaJob, WritesASmallPictureOfTheSameShape) {
  const auto result = Run("clip", "--thumbnail " + (folder_ / "small.png").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const ColourImage picture = ReadColourImage(folder_ / "p.png"),
                    small = ReadColourImage(folder_ / "small.png");
  EXPECT_EQ(small.width, std::min(320, picture.width));
  EXPECT_NEAR(small.height, static_cast<double>(small.width) * picture.height / picture.width, 0.5);
}

TEST_F(PanoramaJob, SceneKeepsTheMedium) {
  for (const std::string medium : {"gas", "saline"}) {
    const auto scene = folder_ / medium;
    const auto result =
        Run("clip", "--medium " + medium + " --scene " + scene.string(), medium + ".png");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto backdrop = nlohmann::json::parse(ReadWholeFile(scene / "scene.json")).at("backdrop");
    EXPECT_EQ(backdrop.value("medium", "saline"), medium);  // saline is left out of the file
  }
}

// PAN-13 and every wrong flag: one sentence, exit 1 or 2, and the old file stays.
TEST_F(PanoramaJob, RefusesInOneSentenceAndLeavesTheOldFile) {
  WriteAtomically(folder_ / "p.png", "old");
  WriteAtomically(folder_ / "bad.json", "{\"evry\": 2}");
  WriteAtomically(folder_ / "lens.json",
                  R"({"model": "equisolid", "width": 1920, "height": 1080, "focal_px": 900,
                      "cx": 960, "cy": 540})");
  TinyClip().WriteAll(folder_ / "one", TinyClip::Arc(1));
  const auto refused = [&](const std::string& footage, const std::string& flags, int code,
                           const std::string& says) {
    const auto result = Run(footage, "--overwrite " + flags);
    EXPECT_EQ(result.exit_code, code) << flags << result.err;
    EXPECT_NE(result.err.find(says), std::string::npos) << flags << "\n" << result.err;
    EXPECT_EQ(result.out, "") << flags;
    EXPECT_EQ(ReadWholeFile(folder_ / "p.png"), "old") << flags;
  };
  refused("none.mp4", "", 1, "no such file");
  refused("one", "", 1, "needs two");
  refused("clip", "--lens " + (folder_ / "none.json").string(), 1, "none.json");
  refused("clip", "--lens " + (folder_ / "lens.json").string(), 1, "1920 x 1080");
  refused("clip", "--options " + (folder_ / "bad.json").string(), 1, "\"evry\" is not known");
  refused("clip", "--every 0", 2, "every");
  refused("clip", "--medium gas", 2, "--scene");
  refused("clip", "--medium air --scene " + (folder_ / "s").string(), 2, "gas");
  refused("clip", "--leave-out 0,1,2", 1, "only 1 frame is left in");
  EXPECT_EQ(Run("clip", "", "p.bmp").exit_code, 1);
  EXPECT_EQ(Run("clip", "", "no/such/p.png").exit_code, 1);
  EXPECT_EQ(test::RunProgram("panorama").exit_code, 2);
}

// PAN-20: a full disk.
TEST_F(PanoramaJob, AFullDiskLeavesTheOldFileAndNoRest) {
  WriteAtomically(folder_ / "p.png", "old");
  const std::string line = "(ulimit -f 8; trap '' XFSZ; " ARTHRO_PROGRAM " panorama " +
                           (folder_ / "clip").string() + " --overwrite -o " +
                           (folder_ / "p.png").string() + ") > /dev/null 2> " +
                           (folder_ / "err").string();
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(ReadWholeFile(folder_ / "err").find("free some space"), std::string::npos)
      << ReadWholeFile(folder_ / "err");
  EXPECT_EQ(ReadWholeFile(folder_ / "p.png"), "old");
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
}

TEST_F(PanoramaJob, HelpListsTheOptionsOfEveryStage) {
  const auto result = test::RunProgram("panorama --help");
  EXPECT_EQ(result.exit_code, 0);
  for (const char* flag : {"--lens", "--report", "--leave-out", "--options", "--every",
                           "--most-frames", "--prepare-surround", "--direct-smallest-overlap",
                           "--compose-feather", "--rectify-rim-margin"})
    EXPECT_NE(result.out.find(flag), std::string::npos) << flag << "\n" << result.out;
}

}  // namespace
}  // namespace arthro
