// Window as its users meet it: its steps, bars, help and sliders. Scripts click by name, type and
// look (app/platform/script/script.h).
#include <string>

#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/app/editor/editor_window.h"
#include "tests/support/run_window.h"

namespace arthro {
namespace {

using test::EditorWindow;
using test::RunWindow;

TEST_F(EditorWindow, EveryStepOpensAndShowsItsControls) {
  Drive(R"(
expect "Small knee"
expect "Import a panorama…"
click Depth
expect "Red weight"
click Tissue
expect "octahedron"
click Portals
expect "Incision spacing"
click "Practice"
expect "Practise in the scene as it stands"
click Help
expect "Practice"
click "Page of the manual"
click "Keys and mouse"
wait frames 3
expect "Swing the scope"
key escape
expect not "Swing the scope"
)");
}

// In a narrow window the bar was cut in the middle of a button, and Practise was out of reach.
TEST_F(EditorWindow, ANarrowBarLeavesOutWhatTheFileMenuHas) {
  Drive(R"(
resize 1280 800
wait frames 3
expect "Save as…"
expect "History…"
resize 640 480
wait frames 3
expect not "Save as…"
expect not "History…"
expect enabled "Practise"
click "File"
wait frames 3
expect "Save as…"
key escape
click "Practise"
wait job
wait frames 5
expect "Force on the tissue"
)");
}

TEST_F(EditorWindow, HelpOpensThePageOfWhatIsShown) {
  Drive(R"(
click Depth
type "?"
wait frames 3
expect "Settings of the estimate"
key escape
click Portals
key f1
wait frames 3
expect "Step 4 sets where scope and instrument enter"
click "Page of the manual"
click "Troubleshooting"
wait frames 3
expect "I feel no force"
key escape
expect not "I feel no force"
key shift+f1
wait frames 3
expect "Over the overview"
)");
}

TEST_F(EditorWindow, ASliderThatIsTypedIntoIsUndoneAndRedone) {
  Drive(R"(
click Portals
expect value "Incision spacing" "30.0 mm"
expect disabled Undo
set "Incision spacing" -25
expect value "Incision spacing" "-25.0 mm"
expect "• Small knee"
click Undo
expect value "Incision spacing" "30.0 mm"
expect not "• Small knee"
key ctrl+shift+z
expect value "Incision spacing" "-25.0 mm"
key ctrl+z
expect value "Incision spacing" "30.0 mm"
)");
}

TEST_F(EditorWindow, ADraggedSliderIsOneStep) {
  Drive(R"(
click Portals
drag "Field of view" 60 0
expect "• Small knee"
click Undo
expect not "• Small knee"
expect disabled Undo
)");
}

TEST_F(EditorWindow, DepthIsMadeAnewWhenASliderIsLetGo) {
  Drive(R"(
click Depth
expect "was imported"
click "Make depth from the picture"
wait job
set "Near relief" 15
wait job
expect value "Near relief" "15.0 mm"
click Save
wait job
expect "Saved in"
)");
  const LoadedScene saved = LoadScene(scene);
  float nearest = 0;
  for (const float h : saved.depth->relief)
    if (h > nearest) nearest = h;
  EXPECT_NEAR(nearest, 0.015, 1e-6);
}

TEST_F(EditorWindow, ReliefThatWouldPassTheIncisionIsNamed) {
  Drive(R"(
click Depth
click "Make depth from the picture"
wait job
set "Near relief" 131
wait job
expect value "Near relief" "47.5 mm"
expect not "behind the incision"
click Panorama
set "Distance of the backdrop" 20
wait job
click Depth
wheel "Near relief" 40
expect "behind the incision"
)");
}

TEST_F(EditorWindow, AFailedExpectationIsToldWithItsLine) {
  const auto result = RunWindow("edit " + scene.string(), "click Portals\nexpect \"purple\"\n");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("line 2"), std::string::npos) << result.err;
}

TEST(NoDisplay, IsSaidInOneSentenceThatNamesTheWayOut) {
  const auto result = test::RunProgram("edit", "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("there is no display"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("arthroscene demo"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace arthro
