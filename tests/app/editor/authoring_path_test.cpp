// The whole way of an author, by real mouse events: footage, panorama, depth mended in one place,
// two models of the library aligned by landmarks, a tear, portals, then saved, shared, opened again
// and practised. The same script without a window gives the same scene.
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/run_window.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

// Clicks lie on the models and the relief that the clip of seed 3 gives, at 1280 x 800.
std::string ScriptOf(const std::string& knee, const std::string& out) {
  return R"(resize 1280 800
click New
drop )" + knee +
         R"(/footage
wait job
click "Lens of the scope"
click "from a file…"
set "File name" )" +
         knee + R"(/lens.json
wait job
click "Measure relief from motion"
click no
click Run
wait job
expect "12 of 12 frames placed"
click "Use this panorama"
wait job
click Depth
wait job
click "Map of the depth"
click Brush
click Smooth
set Size 20
stroke "Depth map" -60 -20 -30 0 0 10 30 20
wait job
expect "Mend depth: Smooth"
click Tissue
click Library
click "Medial meniscus"
wait job
click "Align by landmarks…"
click "Overview alone"
wait frames 3
click "Solve for the scale"
click Overview 45 72
click Overview 39 66
click Overview 100 47
click Overview 94 41
click Overview -5 62
click Overview -11 56
wait frames 3
expect "Landmark 3"
click Align
wait frames 3
expect "Aligned medial meniscus to"
key escape
click Library
click "Loose body"
wait job
click "Align by landmarks…"
wait frames 3
click "Solve for the scale"
click Overview 12 -52
click Overview 6 -56
click Overview 46 -60
click Overview 40 -64
click Overview 40 -26
click Overview 34 -30
wait frames 3
expect "Landmark 3"
click Align
wait frames 3
expect "Aligned loose body to"
key escape
click "Both views"
click "medial meniscus"
click Cut
click "Tears of a meniscus"
click "Make this tear"
wait job
expect "tear of"
click Portals
click "Scope, instrument"
wait frames 3
click "Anteromedial, anterolateral"
wait frames 3
click "Save as…"
set "File name" )" +
         out + R"(/mine
click Save
wait job
expect "Saved in"
click "Save as…"
set "File name" )" +
         out + R"(/shared.arthro
click Save
wait job
expect "Saved in"
click "Open…"
set "File name" )" +
         out + R"(/shared.arthro
wait job
expect "Opened"
click Practice
click "Practise"
wait job
wait frames 20
expect "Leave practice"
)";
}

// The text of scene.json without the fingerprint of footage.json, which states how long its run
// took.
std::string SceneText(const std::filesystem::path& folder) {
  std::istringstream lines(ReadWholeFile(folder / "scene.json"));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (line.find("\"footage.json\": ") == std::string::npos) text += line + "\n";
  return text;
}

TEST(AuthoringPath, LeadsFromFootageToASharedSceneAndRepeatsWithoutAWindow) {
  ARTHRO_REQUIRE_XVFB();
  const test::TempFolder temp;
  const std::string knee = (temp / "knee").string();
  const auto phantom = test::RunProgram("phantom --seed 3 --size S --footage-frames 12 -o " + knee);
  ASSERT_EQ(phantom.exit_code, 0) << phantom.err;
  std::filesystem::create_directories(temp / "seen");
  std::filesystem::create_directories(temp / "run");
  const auto seen = test::RunWindow("edit --size 1280x800",
                                    ScriptOf(knee, (temp / "seen").string()), "1280x800x24");
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  const LoadedScene scene = LoadScene(temp / "seen/shared.arthro");
  ASSERT_EQ(scene.scene.tissues.size(), 2u);
  EXPECT_FALSE(scene.scene.tissues[0].cuts.empty());
  EXPECT_LT(scene.scene.portals.incision_spacing, 0) << "the portals changed sides";
  EXPECT_TRUE(scene.depth);

  std::ofstream(temp / "path.script") << ScriptOf(knee, (temp / "run").string());
  const auto run = test::RunProgram(
      "run " + (temp / "path.script").string(),
      "HOME=" + (temp / "run").string() + " LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(SceneText(temp / "seen/mine"), SceneText(temp / "run/mine"));
}

}  // namespace
}  // namespace arthro
