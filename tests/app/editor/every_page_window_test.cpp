// Every page of the window, in German: all its texts have an entry, and all its values a tip. Texts
// are collected as they are asked for (Translation::missing), also those of tips that nobody saw.
#include <gtest/gtest.h>

#include "simulation/scene/image_io.h"
#include "tests/app/editor/editor_window.h"

namespace arthro {
namespace {

class EveryPage : public test::EditorWindow {
 protected:
  // A window that is tall enough to show every control. `names`: those of the data.
  void Visit(const std::string& pages, const std::string& names = "") {
    Drive("resize 1280 4000\nwait frames 3\n" + pages +
              "\nwait frames 5\nexpect translated octahedron \"Small knee\" knee " + names + "\n",
          "--language german");
  }
};

TEST_F(EveryPage, OfPanoramaAndDepthIsGermanWithTips) {
  Visit(R"(
do step-panorama
wait frames 3
expect tips
click Crop
wait frames 2
click "Known length"
wait frames 2
do step-depth
wait job
expect tips
do depth-map
wait frames 3
expect tips
do map-origin
wait frames 3
do map-sigma
wait frames 3
do map-range
wait frames 3
do map-shape
wait frames 3
do map-masks
wait frames 3
do map-compare
wait frames 5
do map-length
wait frames 3
expect tips
do map-profile
wait frames 3
drag "Depth map" 60 20
wait frames 3
do map-compare
do map-brush
wait frames 3
expect tips
do map-read
click "Depth map"
wait frames 3
do touch-preview
wait frames 3
expect tips
do make-depth
wait job
wait frames 3
expect tips
)");
}

TEST_F(EveryPage, OfTissueIsGermanWithTips) {
  Visit(R"(
do step-tissue
wait frames 3
expect tips
click Library
wait frames 20
expect tips
click Library
do landmarks
wait frames 3
expect tips
click Overview
wait frames 3
do leave-landmarks
click Material
wait frames 3
expect tips
click Mesh
wait frames 3
expect tips
do tetrahedralise
wait job
click Hold
wait frames 3
expect tips
do hold-at-instrument
wait frames 3
expect tips
click Cut
wait frames 3
expect tips
do cut-tear
wait frames 3
expect tips
do cut-bite
wait frames 3
expect tips
do cut-region
wait frames 3
expect tips
do poke
wait job
wait frames 5
do poke
do add-solid
wait job
click Solid
wait frames 3
expect tips
do add-capsule
wait frames 3
expect tips
do add-torus
wait frames 3
expect tips
do add-box
wait frames 3
expect tips
do add-plane
wait frames 3
expect tips
)");
}

TEST_F(EveryPage, OfPortalsAndPracticeIsGermanWithTips) {
  Visit(R"(
do step-portals
wait frames 3
expect tips
click "Show reach"
wait frames 60
wait job
click "Scope, instrument"
wait frames 3
key escape
do step-practice
wait frames 3
expect tips
do rig
wait frames 3
expect tips
do new-rig
wait frames 3
expect tips
do rig
do budget
wait frames 3
expect tips
do budget
do practise
wait job
wait frames 10
expect tips
do devices
wait frames 3
expect tips
do disturbances
wait frames 3
expect tips
)");
}

TEST_F(EveryPage, OfExercisesFilesAndHelpIsGermanWithTips) {
  Visit(R"(
do step-exercises
wait frames 3
do new-exercise
wait frames 3
expect tips
key ctrl+,
wait frames 3
expect tips
key escape
do history
wait frames 3
expect tips
key escape
click File
wait frames 3
key escape
do start-page
wait frames 3
expect tips
do keys
wait frames 3
key escape
)");
}

TEST_F(EveryPage, OfFootageIsGermanWithTips) {
  const std::filesystem::path frames = temp / "frames";
  std::filesystem::create_directory(frames);
  for (int i = 0; i < 3; ++i)
    std::filesystem::copy_file(scene / "panorama.png",
                               frames / ("frame" + std::to_string(i) + ".png"));
  Visit("drop " + frames.string() + R"(
wait job
wait frames 5
expect tips
click "More options"
wait frames 2
click Straightening
click "Evening out the light"
click "Direct alignment"
click "Which frames are compared"
click "Loops that must close"
click "Placing all frames at once"
click "Drawing the panorama"
wait frames 5
expect tips
click Run
wait job
wait frames 5
expect tips
)",
        "frames");
}

}  // namespace
}  // namespace arthro
