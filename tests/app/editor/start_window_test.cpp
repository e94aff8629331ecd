// The start page, the settings, and the window without a mouse or in German.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using test::RunWindow;

class StartWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    fs::create_directories(temp / "a");
    fs::create_directories(temp / "b");
    scene = test::WriteSmallScene(temp / "a" / "knee");
    fs::copy(scene, temp / "b" / "knee", fs::copy_options::recursive);
    std::ofstream(temp / "recent.json")
        << "{\"scenes\": [\"" << scene.string() << "\", \"" << (temp / "b" / "knee").string()
        << "\", \"" << (temp / "gone").string() << "\"]}";
  }
  void Drive(const std::string& script, const std::string& flags = "") {
    const auto result = RunWindow(
        "edit " + scene.string() + " --recent " + (temp / "recent.json").string() + " " + flags,
        script);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  test::TempFolder temp;
  fs::path scene;
};

TEST_F(StartWindow, ShowsRecentScenesByTitleAndFolderAndOpensOne) {
  Drive(
      "click Start\nwait job\nexpect \"New from footage…\"\nexpect \"Small knee\"\n"
      "expect value \"Small knee#1\" " +
      scene.string() + "\nexpect value \"Small knee#2\" " + (temp / "b" / "knee").string() +
      "\nexpect not gone\nclick \"Small knee#2\"\nwait job\nexpect \"Opened " +
      (temp / "b" / "knee").string() + "\"\nexpect \"Import a panorama…\"\n");
}

TEST_F(StartWindow, GoesBackToTheSceneAsItWas) {
  Drive(R"(
click Portals
set "Incision spacing" 22
click Start
wait job
expect "Recent scenes"
expect not "Incision spacing"
click Start
expect value "Incision spacing" "22.0 mm"
)");
}

TEST_F(StartWindow, ASceneThatCannotBeReadSaysSoAndBlocksNothing) {
  std::ofstream(temp / "b" / "knee" / "scene.json") << "{";
  Drive(
      "click Start\nwait job\nexpect \"Cannot be opened\"\nclick \"Small knee\"\nwait job\n"
      "expect \"Import a panorama…\"\n");
}

// Stops the work at once, since all of it takes a minute of processor time. No part of the folder
// is written.
TEST_F(StartWindow, MakesADigitalKneeBesideTheWindowAndStops) {
  const fs::path folder = temp / "digital-knee";
  Drive("click Start\nclick \"New from a digital knee…\"\nset \"File name\" " + folder.string() +
        "\nwait frames 3\nexpect \"Make a digital knee\"\nclick Stop\n"
        "wait job\nexpect not Run\n");
  EXPECT_FALSE(fs::exists(folder));
}

TEST_F(StartWindow, PutsNoDigitalKneeIntoAFolderOfOtherFiles) {
  Drive("click Start\nclick \"New from a digital knee…\"\nset \"File name\" " +
        (temp / "a").string() + "\nclick \"Make it\"\nwait job\nexpect not Run\n");
  EXPECT_FALSE(fs::exists(temp / "a/footage"));
}

TEST_F(StartWindow, TheManualIsReadFromPageToPage) {
  Drive(R"(
click Help
click "Page of the manual"
click "Manual of Arthroscene"
click Jobs
expect "Jobs of the command line"
click method.md
expect Units
click "Page of the manual"
click "Keys and mouse"
click "About this program"
click "Show the texts of the licences"
expect "======== libceres-dev ========"
)");
}

TEST_F(StartWindow, SettingsChangeTheLooksAtOnce) {
  Drive(R"(
key ctrl+,
expect value Theme dark
click Theme
click light
expect value Theme light
click Language
click Deutsch
click "Interface scale"
click 1.5
wait frames 4
click Close
expect "Import a panorama…"
)");
}

// Names and texts stay English for scripts, whatever is drawn.
TEST_F(StartWindow, ScriptsAreTheSameInGerman) {
  Drive(R"(
click Portals
set "Incision spacing" 22
click Save
wait job
expect "Saved in"
)",
        "--language german");
}

TEST_F(StartWindow, TabReachesEveryControlOfEveryPage) {
  Drive(R"(
walk
click Depth
walk
click Tissue
walk
click Portals
walk
click Practice
walk
click Start
wait job
walk
key ctrl+,
walk
)");
}

TEST_F(StartWindow, TabAndSpacePressAButton) {
  Drive(R"(
key tab
expect focus File
key tab
expect focus Start
key space
wait job
expect "Recent scenes"
)");
}

TEST_F(StartWindow, EveryControlWithAValueHasATip) {
  Drive(R"(
expect tips
click Depth
expect tips
click Tissue
expect tips
click Portals
expect tips
click Practice
expect tips
key ctrl+,
expect tips
)");
}

}  // namespace
}  // namespace arthro
