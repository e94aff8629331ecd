// The map of the depth in the window, by its users' hands: scripts that click and drag with the
// mouse.
#include <filesystem>

#include <gtest/gtest.h>

#include "authoring/project/document_io.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/measured_scene.h"
#include "tests/support/run_window.h"

namespace arthro {
namespace {

class DepthMapWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    authoring::SaveDocument(test::MeasuredDocument(), scene);
  }
  // The map fills the window beside the panel, so a window of one size has it at one scale.
  void Drive(const std::string& script) {
    const auto result = test::RunWindow("edit " + scene.string() + " --size 1280x800",
                                        "click Depth\nclick \"Map of the depth\"\n" + script);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  test::TempFolder temp;
  std::filesystem::path scene = temp / "scene";
};

TEST_F(DepthMapWindow, ShowsOriginUncertaintyAndDistanceWithALegend) {
  Drive(R"(expect "Measured from the motion of the scope."
expect "measured, 74 %"
expect "estimated from brightness, "
expect "interpolated, "
click Uncertainty
expect "Standard error"
expect "2 mm and more"
click Distance
expect "Distance from the portal"
click "Picture only"
expect not "2 mm and more"
click "Scope view"
expect "Overview"
expect enabled "Make depth from the picture"
)");
}

TEST_F(DepthMapWindow, AClickReadsTheRangeWithItsStandardError) {
  Drive(R"(expect "Click on the map to read the distance there."
click "Depth map"
expect " ± 0.2 mm from the portal, measured"
expect "Within 1 mm with a probability of 100 %."
click "Depth map" -380 100
expect "40.0 ± 2.0 mm from the portal, estimated from brightness"
wheel "Depth map" 4
click "Depth map"
expect " ± 0.2 mm from the portal, measured"
)");
}

TEST_F(DepthMapWindow, ALengthSetsTheScaleAndASecondOneMustAgree) {
  Drive(R"(click "Give a length"
expect disabled "Set the scale"
click "Depth map" -100 -100
expect "Click on the second point."
click "Depth map" 200 150
expect "Now the points are"
set "Known length" 15
click "Set the scale"
expect "The scale changed: the radius of the backdrop was 40.0 mm and is"
expect "Now the points are 15.0 mm apart."
click Instrument
click "Depth map" -100 -100
click "Depth map" 200 150
set "Known length" 18
click "Set the scale"
expect "disagree by 20 %"
click OK
click Undo
expect disabled Undo
click Redo
click Save
wait job
expect "Saved in"
)");
  EXPECT_NE(LoadScene(scene).scene.backdrop.radius, test::kMeasuredRadius);
}

TEST_F(DepthMapWindow, ALineThatIsDraggedShowsItsProfile) {
  Drive(R"(click Profile
expect "The profile of a line appears here."
drag "Depth map" 300 20
expect "Along the line the tissue lies"
expect "Distance from the portal along the line, mm"
)");
}

TEST_F(DepthMapWindow, TheProfileIsDrawnBelowThePicturesThatAreCompared) {
  Drive(R"(click "Side by side"
click Profile
expect "The profile of a line appears here."
drag "Depth map" 100 20
expect "Along the line the tissue lies"
expect "Distance from the portal along the line, mm"
expect "Filtered grey"
)");
}

TEST_F(DepthMapWindow, AStrokeOfTheBrushIsOneStepThatIsUndone) {
  Drive(R"(click Brush
click Mask
set Size 12
drag "Depth map" 150 0
expect "Mend depth: Mask"
click Undo
expect disabled Undo
click Redo
click Save
wait job
expect "Saved in"
)");
  const LoadedScene saved = LoadScene(scene);
  ASSERT_TRUE(saved.depth_origin);
  EXPECT_EQ(saved.depth_origin->at(65, 40), ReliefOrigin::kInterpolated);
}

// Weights of the grey could be moved with an estimator that does not use them.
TEST_F(DepthMapWindow, OptionsThatTheEstimatorDoesNotUseAreGrey) {
  Drive(R"(click "Scope view"
click "Make depth from the picture"
click Estimator
click grey
wait job
expect enabled "Red weight"
expect enabled "Colour filter"
expect disabled "Steps of the shading"
click Estimator
click shading
wait job
expect disabled "Red weight"
expect disabled "Green weight"
expect disabled "Colour filter"
expect disabled "Fall of brightness with distance"
expect enabled Gamma
expect enabled "Steps of the shading"
)");
}

}  // namespace
}  // namespace arthro
