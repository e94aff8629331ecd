// The way of somebody who uses the window for the first time: from the footage of a digital knee to
// a scene with two tissues and a tear that can be practised in.
#include <cstdio>
#include <sstream>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/support/run_window.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

// s of processor time of all programs that this one has started and that have ended.
double SecondsOfChildren() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Actions of a user in a script: waiting and looking are none.
int CommandsOf(const std::string& script) {
  std::istringstream lines(script);
  int commands = 0;
  for (std::string line; std::getline(lines, line);)
    commands += !line.empty() && !line.starts_with("wait") && !line.starts_with("expect") ? 1 : 0;
  return commands;
}

TEST(NewcomerPath, LeadsFromFootageToASceneWithTwoTissuesAndATearInTwentyFiveCommands) {
  ARTHRO_REQUIRE_XVFB();
  const test::TempFolder temp;
  const auto knee = test::RunProgram("phantom --seed 3 --size S --footage-frames 12 -o " +
                                     (temp / "knee").string());
  ASSERT_EQ(knee.exit_code, 0) << knee.err;
  // The window opens with the demo.
  const std::string script = "click New\ndrop " + (temp / "knee/footage").string() + R"(
wait job
click "Lens of the scope"
click "from a file…"
set "File name" )" + (temp / "knee/lens.json").string() +
                             R"(
wait job
click "Measure relief from motion"
click no
click Run
wait job
expect "12 of 12 frames placed"
click "Use this panorama"
wait job
click Tissue
click Library
click "Loose body"
wait job
click Library
click "Medial meniscus"
wait job
expect "Medial meniscus lies on the relief"
click Cut
click "Tears of a meniscus"
click "Make this tear"
wait job
expect "tear of"
click "Save as…"
set "File name" )" + (temp / "mine").string() +
                             R"(
click Save
wait job
expect "Saved in"
click Practice
expect not "has no tetrahedra"
expect not "Nothing holds"
click "Practise"
wait job
wait frames 20
expect "Leave practice"
)";
  EXPECT_LE(CommandsOf(script), 25);
  const double before = SecondsOfChildren();
  const auto window = test::RunWindow("edit --size 1280x800", script, "1280x800x24");
  ASSERT_EQ(window.exit_code, 0) << window.err;
  const double seconds = SecondsOfChildren() - before;
  std::printf("%d commands, %.0f s of processor time\n", CommandsOf(script), seconds);
  EXPECT_LE(seconds, 180) << "three minutes of a machine that does nothing else";
  const LoadedScene scene = LoadScene(temp / "mine");
  ASSERT_EQ(scene.scene.tissues.size(), 2u);
  EXPECT_FALSE(scene.scene.tissues[1].cuts.empty());
  EXPECT_FALSE(scene.scene.tissues[1].mesh.empty());
  EXPECT_TRUE(scene.depth);
}

}  // namespace
}  // namespace arthro
