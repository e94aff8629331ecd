// A tissue aligned by landmarks, as its user does it: scripts click into both pictures.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

class LandmarkWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene_ = test::WriteSmallScene(temp_ / "knee");
  }
  // A failed script tells its line on stderr.
  void Drive(const std::string& script) {
    const auto result =
        test::RunWindow("edit " + scene_.string() + " --size 1280x800",
                        "click Tissue\nclick \"Align by landmarks…\"\n" + script, "1280x800x24");
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  test::TempFolder temp_;
  std::filesystem::path scene_;
};

TEST_F(LandmarkWindow, APairIsAClickIntoEachPictureAndEscapeLeaves) {
  Drive(R"(
expect "Click a point of octahedron in the overview"
expect disabled Align
expect not "Landmark 1"
expect value Longitude "0.0°"
click Picture 30 40
wait frames 3
expect "Now click the same point of octahedron in the overview."
expect value Longitude "0.0°"
click Overview 11 -21
wait frames 3
expect "Landmark 1"
expect "Three pairs or more are needed"
click Overview 11 -21
wait frames 3
expect "Now click its place in the scope's picture"
key escape
wait frames 3
expect not "Landmark 1"
expect "Fit to the relief"
expect "are kept with the scene"
click Mesh
wait frames 3
expect not "are kept with the scene"
quit
)");
}

TEST_F(LandmarkWindow, ThreePairsAlignAndUndoTakesItBack) {
  Drive(R"(
click Overview 11 -21
click Picture 0 0
click Overview 14 -22
click Picture 19 -6
click Overview 13 -26
click Picture 12 -30
wait frames 5
expect "Landmark 3"
expect "Expected error"
expect "Nothing checks three pairs"
expect enabled Align
click Align
wait frames 5
expect "Aligned octahedron to"
expect enabled Undo
click Save
wait job
quit
)");
  const glm::dvec3 moved = ReadScene(scene_).tissues.at(0).pose.position;
  EXPECT_GT(glm::distance(moved, glm::dvec3(0, 0, 0.03)), 1e-4);
}

}  // namespace
}  // namespace arthro
