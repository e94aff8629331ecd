// Views of the window: scope picture and overview, turned, resized and swapped by mouse.
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "simulation/scene/image_io.h"
#include "tests/app/editor/editor_window.h"
#include "tests/support/run_window.h"

namespace arthro {
namespace {

using test::EditorWindow;
using test::RunWindow;

TEST_F(EditorWindow, DragAndWheelOverThePictureMoveTheScope) {
  Drive(R"(
expect value Longitude "0.0°"
drag Picture 80 0
wheel Picture 3
wait frames 3
expect value Insertion "18.0 mm"
)");
}

TEST_F(EditorWindow, ADragInTheOverviewTurnsItUnlessItBeginsOnTheHandle) {
  Drive(R"(
click Tissue
wait frames 3
wheel Overview 12
wait frames 3
drag Overview 60 10
wait frames 3
expect not "Place octahedron"
expect disabled Undo
click Fit
wait frames 3
drag Handle 30 0
wait frames 3
expect "Place octahedron"
click Undo
expect disabled Undo
expect value "Position (right, down, in), in" "30.0 mm"
)");
}

TEST_F(EditorWindow, ViewsHaveASizeOfTheirOwnChangeSidesAndStandAlone) {
  Drive(R"(
drag "Border of the views" -150 0
wait frames 5
shot )" +
        (temp / "wide.png").string() +
        R"(
click Swap
wait frames 5
click "Overview alone"
wait frames 5
expect not "Insertion"
key ctrl+3
wait frames 5
expect "Insertion"
key ctrl+1
wait frames 5
expect not "Overview alone"
click "Both views"
wait frames 5
expect "Overview alone"
)");
}

TEST_F(EditorWindow, AHighDensityScreenIsTheSameWindowTwiceAsLarge) {
  const auto shot = temp / "shot.png";
  const auto result = RunWindow("edit " + scene.string() + " --scale 2",
                                "click Portals\nexpect \"Incision spacing\"\nset \"Incision "
                                "spacing\" 5\nexpect value \"Incision spacing\" \"5.0 mm\"\nshot " +
                                    shot.string(),
                                "2560x1600x24");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(ReadColourImage(shot).width, 2560);
}

// It opened at the size of scale 1, with half of its words cut off.
TEST_F(EditorWindow, TheWindowOpensAtTheScaleThatWasChosen) {
  const auto shot = temp / "shot.png";
  const auto result = RunWindow("edit " + scene.string() + " --interface-scale 2",
                                "click Tissue\nshot " + shot.string(), "2560x1600x24");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(ReadColourImage(shot).width, 2560);
}

// Each page on the screens that people have: no control is cut off or lies over another.
TEST_F(EditorWindow, PagesFitTheirWindowAtEveryUsualSizeAndScale) {
  std::string pages = "wait job\nwait frames 5\nexpect layout\n";
  for (const char* page : {"depth", "tissue", "portals", "practice", "exercises", "panorama"}) {
    pages += std::string("do step-") + page + "\nwait frames 5\nexpect layout\nshot " +
             (temp / (std::string(page) + ".png")).string() + "\n";
    if (std::string_view(page) == "tissue")
      for (const char* part : {"Material", "Mesh", "Hold", "Cut", "Place"})
        pages += std::string("click ") + part + "\nwait frames 5\nexpect layout\n";
  }
  const struct {
    const char* flags;
    const char* screen;
    int width;
  } kWindows[] = {{"--size 1280x800", "1280x800x24", 1280},
                  {"--size 1920x1080", "1920x1080x24", 1920},
                  {"--size 1280x800 --scale 2", "2560x1600x24", 2560}};
  for (const auto& window : kWindows) {
    const auto result =
        RunWindow("edit " + scene.string() + " " + window.flags, pages, window.screen);
    EXPECT_EQ(result.exit_code, 0) << window.flags << ": " << result.err;
    EXPECT_EQ(ReadColourImage(temp / "portals.png").width, window.width) << window.flags;
  }
}

TEST_F(EditorWindow, ThePictureAtRestIsTheSameWithASmallMovingPicture) {
  Drive(R"(
pose scope 0.015 -0.2 0 0
wait frames 60
shot )" +
        (temp / "full.png").string() +
        R"(
key ctrl+,
click "Moving picture"
click small
click Close
pose scope 0.015 -0.3 0.1 0
wait frames 3
pose scope 0.015 -0.2 0 0
wait frames 60
shot )" +
        (temp / "small.png").string() + "\n");
  EXPECT_EQ(ReadColourImage(temp / "small.png").rgb, ReadColourImage(temp / "full.png").rgb);
}

TEST_F(EditorWindow, TheSameScriptGivesTheSamePicture) {
  const std::string shots[] = {(temp / "a.png").string(), (temp / "b.png").string()};
  for (const auto& shot : shots) Drive("drag Picture 40 20\nwheel Picture 2\nshot " + shot);
  EXPECT_EQ(ReadColourImage(shots[0]).rgb, ReadColourImage(shots[1]).rgb);
}

}  // namespace
}  // namespace arthro
