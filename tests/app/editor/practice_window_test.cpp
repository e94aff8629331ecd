// Practice in the window: hands, devices, disturbances and the way back.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/app/editor/editor_window.h"
#include "tests/support/run_window.h"

namespace arthro {
namespace {

using test::EditorWindow;
using test::RunWindow;

TEST_F(EditorWindow, PracticeAndBackLeavesTheAuthorWhereTheyWere) {
  Drive(R"(
click Portals
set "Incision spacing" 22
key p
wait job
wait frames 10
expect "Force on the tissue"
expect "nothing"
hold w 12
expect "octahedron"
key 3
expect "70° view angle"
key escape
expect value "Incision spacing" "22.0 mm"
click Undo
expect value "Incision spacing" "30.0 mm"
)");
}

TEST_F(EditorWindow, TheDevicesPanelSaysWhatHoldsTheHandsAndWhyThereIsNoForce) {
  Drive(R"(
click Practice
click Devices
expect "No device holds this hand"
click "Hide devices"
expect not "No device holds this hand"
key p
wait job
hold r 60
click Devices
expect "simulated device, serial 2"
expect "ready, without force"
expect "Nobody holds the dead-man"
expect value "Instrument force meter" "0.00 N"
expect value "Zero-force mode" off
key 0
expect value "Zero-force mode" on
expect "Zero-force mode is on"
click "Zero-force mode"
expect value "Zero-force mode" off
key f4
expect "Force on the tissue"
expect not "simulated device"
key escape
click Devices
expect "No device holds this hand"
)",
        "--hands plant");
}

TEST_F(EditorWindow, DisturbancesAreSwitchedOnAndOffAndMoveOnlyWhereTheyDo) {
  const auto file = [&](const char* name) { return (temp / name).string(); };
  Drive(R"(
key p
wait job
wait frames 5
expect value "Disturbances" off
shot )" +
        file("clear.png") +
        R"(
key f3
expect value "Fogged lens" off
expect value "Fogged lens strength" "0.50"
expect disabled "Clear view"
click "Fogged lens"
expect value "Fogged lens" on
set "Fogged lens strength" 0.8
expect value "Fogged lens strength" "0.80"
wait frames 3
shot )" +
        file("fog.png") +
        R"(
wait frames 30
shot )" +
        file("fog_later.png") +
        R"(
click "Bleeding"
wait frames 3
shot )" +
        file("blood.png") +
        R"(
wait frames 30
shot )" +
        file("blood_later.png") +
        R"(
click "Clear view"
expect value "Fogged lens" off
expect value "Bleeding" off
expect value "Fogged lens strength" "0.80"
click "Hide disturbances"
expect "Force on the tissue"
expect value "Disturbances" off
wait frames 3
shot )" +
        file("clear_again.png") +
        R"(
click "Disturbances"
click "Debris"
key f3
expect value "Disturbances" on
key escape
)");
  // The middle of the scope's picture, where no clock runs.
  const auto seen = [&](const char* name) {
    const ColourImage shot = ReadColourImage(file(name));
    std::vector<std::uint8_t> pixels;
    for (int y = shot.height / 3; y < shot.height * 2 / 3; ++y)
      pixels.insert(pixels.end(), shot.at(shot.width / 5, y), shot.at(shot.width / 2, y));
    return pixels;
  };
  EXPECT_NE(seen("fog.png"), seen("clear.png"));
  EXPECT_EQ(seen("fog_later.png"), seen("fog.png"));
  EXPECT_NE(seen("blood.png"), seen("fog.png"));
  EXPECT_NE(seen("blood_later.png"), seen("blood.png"));
  // The flecks of the fluid drifted with the blood.
  const std::vector<std::uint8_t> clear = seen("clear.png"), again = seen("clear_again.png");
  ASSERT_EQ(again.size(), clear.size());
  std::size_t other = 0;
  for (std::size_t i = 0; i < clear.size(); ++i) other += again[i] != clear[i];
  EXPECT_LT(static_cast<double>(other), 0.01 * static_cast<double>(clear.size()));
}

TEST_F(EditorWindow, ADeviceThatARigNamesAndIsAbsentIsToldInOneSentence) {
  const auto rig = temp / "rig.json";
  std::ofstream(rig) << R"({"schema": "arthroscene.rig/1", "title": "t", "scope": {
    "device": {"family": "space_mouse", "serial": "that nobody has"}, "rod_length": 0.2}})";
  Drive(R"(
key p
wait job
wait frames 5
expect "No SpaceMouse: mouse and keys hold the scope."
hold right 20
wait frames 2
)",
        "--rig " + rig.string());
}

// A practice with simulated devices writes a log, which the replay and another practice can play.
TEST_F(EditorWindow, PracticeWritesALogThatReplayAndPracticePlay) {
  const std::string log = (temp / "practice.log").string();
  Drive(R"(
key p
wait job
hold r 120
wait frames 60
key escape
)",
        "--hands plant --log " + log);
  for (const char* forces : {"a.csv", "b.csv"}) {
    const auto run = test::RunProgram("replay " + scene.string() + " " + log + " -o " +
                                      (temp / forces).string());
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const std::string a = ReadWholeFile(temp / "a.csv");
  EXPECT_GT(std::count(a.begin(), a.end(), '\n'), 2 * 2900)
      << "three seconds, each tick, each hand";
  EXPECT_TRUE(a == ReadWholeFile(temp / "b.csv")) << "bit-identical";
  Drive(R"(
key p
wait job
wait frames 30
click Devices
expect "recorded hand"
expect "A recording holds this hand"
)",
        "--hands " + log);
}

TEST_F(EditorWindow, ThePractiseJobOffersAnotherGoOrTheWayOut) {
  const auto result = RunWindow("practise " + scene.string(), R"(
wait job
wait frames 20
expect "Force on the tissue"
key escape
expect "Practice ended"
click "Practise again"
wait job
expect "Force on the tissue"
click "Leave practice"
click Quit
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace arthro
