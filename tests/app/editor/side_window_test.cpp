// Side of the knee in the window: one value of the scene on every page.
#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/app/editor/editor_window.h"

namespace arthro {
namespace {

using test::EditorWindow;

TEST_F(EditorWindow, ASideStatedOnOnePageNamesPortalsAndModelsOfTheOthers) {
  Drive(R"(
do step-panorama
expect value Side "not stated"
click Side
click "left knee"
do step-portals
expect not "The side is not stated"
set "Incision spacing" -30
expect value "Scope, instrument" "Anterolateral, anteromedial"
click "Right knee"
expect value "Scope, instrument" "Anteromedial, anterolateral"
do step-tissue
click Library
expect value Side "right knee"
click Side
click "left knee"
do step-portals
expect value "Scope, instrument" "Anterolateral, anteromedial"
click Undo
expect value "Scope, instrument" "Anteromedial, anterolateral"
do step-panorama
expect value Side "right knee"
click "Mirror for the other knee"
wait job
do step-portals
expect value "Incision spacing" "30.0 mm"
expect value "Scope, instrument" "Anteromedial, anterolateral"
click Save
wait job
expect "Saved in"
)");
  EXPECT_EQ(ReadScene(scene).side, BodySide::kLeft);
}

}  // namespace
}  // namespace arthro
