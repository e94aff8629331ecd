// The way from the X server through GLFW to the scene: real clicks and keys by xdotool, no script.
// Positions at 1280x800 follow from the layout (app/editor/panels/bars.cpp).
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

// Runs `actions` (a shell script, $W the window) once the window stands. Exit code of the program;
// 97 when there was no window.
int WithDesktop(const std::filesystem::path& scene, const std::string& actions) {
  test::TempFolder folder;
  const auto file = folder / "desktop.sh";
  std::ofstream(file)
      << "export HOME=" << folder.path().string() << " LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1\n"
      << ARTHRO_PROGRAM " edit " << scene.string() << " --timing 2>" << (folder / "log").string()
      << " &\n"
      << "PROGRAM=$!\n"
      << "for i in $(seq 6000); do grep -q 'first picture' " << (folder / "log").string()
      << " && break; sleep 0.1; done\n"
      << "W=$(timeout 600 xdotool search --sync --name Arthroscene | head -1)\n"
      << "[ -n \"$W\" ] || { kill $PROGRAM; exit 97; }\n"
      << "click() { xdotool mousemove --window $W $1 $2; sleep 0.15; xdotool click 1; "
         "sleep 0.3; }\n"
      << "saved() { for i in $(seq 3000); do [ " << scene.string() << "/scene.json -nt "
      << file.string() << " ] && break; sleep 0.2; done; sleep 1; }\n"
      << "xdotool windowfocus $W; sleep 0.5\n"
      << actions << "\nwait $PROGRAM\n";
  const int status = std::system(
      ("timeout 1500 xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' sh " + file.string())
          .c_str());
  return WEXITSTATUS(status);
}

class Desktop : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    if (std::system("command -v xdotool > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "SKIPPED: xdotool is not on this machine, so no real click is tested";
    scene = test::WriteSmallScene(temp / "knee");
  }
  test::TempFolder temp;
  std::filesystem::path scene;
};

TEST_F(Desktop, RealClicksAndKeysChangeAndSaveTheScene) {
  const int exit_code = WithDesktop(scene, R"(
click 60 139
xdotool keydown ctrl; sleep 0.15; click 160 411; xdotool keyup ctrl; sleep 0.3
xdotool key ctrl+a; sleep 0.2
xdotool type --delay 60 12; sleep 0.3
xdotool key Return; sleep 0.3
xdotool key ctrl+s; saved
xdotool key ctrl+q
)");
  EXPECT_EQ(exit_code, 0);
  EXPECT_NEAR(ReadScene(scene).portals.incision_spacing, 0.012, 1e-12);
}

TEST_F(Desktop, SixFastClicksAreSixClicks) {
  // Undo after six clicks on six different view angles: each click is a step.
  const int exit_code = WithDesktop(scene, R"(
click 60 139
for x in 50 200 50 200 50 200; do xdotool mousemove --window $W $x 661; xdotool click 1; sleep 0.02; done
sleep 1
xdotool key ctrl+z; sleep 0.3
xdotool key ctrl+z; sleep 0.3
xdotool key ctrl+s; saved
xdotool key ctrl+q
)");
  EXPECT_EQ(exit_code, 0);
  // 30° at first; then 0, 70, 0, 70, 0, 70; two taken back leave the fourth.
  EXPECT_NEAR(ReadScene(scene).scope.view_angle, 70 * 3.14159265358979 / 180, 1e-9);
}

}  // namespace
}  // namespace arthro
