// The window as its users meet it: scripts click by name, type and look
// (app/platform/script/script.h).
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using test::RunWindow;

class EditorWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = test::WriteSmallScene(temp / "knee");
  }
  // A failed script tells its line on stderr.
  void Drive(const std::string& script, const std::string& flags = "") {
    const auto result = RunWindow("edit " + scene.string() + " " + flags, script);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  test::TempFolder temp;
  fs::path scene;
};

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

TEST_F(EditorWindow, DragAndWheelOverThePictureMoveTheScope) {
  Drive(R"(
expect value Longitude "0.0°"
drag Picture 80 0
wheel Picture 3
wait frames 3
expect value Insertion "18.0 mm"
)");
}

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

TEST_F(EditorWindow, SaveAsWritesAWholeSceneElsewhere) {
  Drive("click Portals\nset \"Incision spacing\" 12\nclick \"Save as…\"\nset \"File name\" \"" +
        (temp / "copy").string() + "\"\nclick Save\nwait job\nexpect \"Saved in\"\n");
  const LoadedScene copy = LoadScene(temp / "copy");
  EXPECT_NEAR(copy.scene.portals.incision_spacing, 0.012, 1e-12);
  EXPECT_EQ(copy.panorama->width, 400);
  EXPECT_EQ(copy.surfaces.size(), 1u);
  EXPECT_NEAR(ReadScene(scene).portals.incision_spacing, 0.03, 1e-12) << "the old one is untouched";
}

TEST_F(EditorWindow, SaveAsWithTheNameOfAnArchiveWritesOneFileThatOpensAgain) {
  Drive("click \"Save as…\"\nset \"File name\" \"" + (temp / "knee.arthro").string() +
        "\"\nclick Save\nwait job\nexpect \"Saved in\"\n");
  EXPECT_TRUE(fs::is_regular_file(temp / "knee.arthro"));
  scene = temp / "knee.arthro";
  Drive("expect \"Small knee\"\nclick Tissue\nexpect octahedron\n");
}

TEST_F(EditorWindow, ClosingWithUnsavedChangesAsks) {
  Drive(R"(
click Portals
set "Incision spacing" 12
close
expect "There are changes that are not saved"
click Cancel
expect "Incision spacing"
key ctrl+q
click Discard
)");
  EXPECT_NEAR(ReadScene(scene).portals.incision_spacing, 0.03, 1e-12);
}

TEST_F(EditorWindow, SaveFirstSavesAndThenGoesOn) {
  Drive(R"(
click Portals
set "Incision spacing" 12
close
click "Save first"
)");
  EXPECT_NEAR(ReadScene(scene).portals.incision_spacing, 0.012, 1e-12);
}

TEST_F(EditorWindow, TissueIsTypedIntoPlaceAndFilledWithTetrahedra) {
  Drive(R"(
click Tissue
set "Position (right, down, in), in" 25
expect value "Position (right, down, in), in" "25.0 mm"
click Mesh
expect "no tetrahedra yet"
expect "About 300 elements"
click "Mesh size"
click coarse
expect "About 150 elements"
click "Make tetrahedra"
wait job
expect "filled with tetrahedra"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  EXPECT_NEAR(saved.tissues.at(0).pose.position.z, 0.025, 1e-12);
  const TetMesh mesh = ReadTetMesh(scene / saved.tissues.at(0).mesh);
  EXPECT_GT(mesh.ElementCount(), 0);
  EXPECT_EQ(mesh.order, 2);
}

TEST_F(EditorWindow, MaterialIsChosenWithItsSourcesAndItsStiffnessTyped) {
  Drive(R"(
click Tissue
click Material
expect value Preset "Meniscus, for probing"
expect value "Stiffness" "0.5 MPa"
click Sources
expect "Danso 2018"
click Sources
set "Stiffness" 0.3
expect value "Stiffness" "0.3 MPa"
expect "Differs from the preset."
click "Instruments may cut it"
click Preset
click "Cartilage, for probing"
expect "Thickness of the layer"
expect not "Differs from the preset."
click Undo
expect value "Stiffness" "0.3 MPa"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  EXPECT_EQ(saved.tissues.at(0).material, "meniscus");
  EXPECT_NEAR(saved.tissues.at(0).elasticity.young_modulus.value_or(0), 3e5, 1e-3);
  EXPECT_FALSE(saved.tissues.at(0).elasticity.poisson_ratio);
  EXPECT_FALSE(saved.tissues.at(0).is_cuttable);
}

TEST_F(EditorWindow, AClickInTheOverviewSaysWhereTheTissueIsProbed) {
  Drive(R"(
click Tissue
set "Position (right, down, in), down" 3
set "Position (right, down, in), in" 22.5
click Mesh
expect "Finer where it is free"
set "Radius of the next ball" 1.5
click "Finer here…"
wait frames 3
click Overview
wait frames 3
expect "Finest in 1 probed place:"
expect value "Ball 1" on
click Hold
expect "Nothing holds this tissue"
click Mesh
click "Make tetrahedra"
wait job
expect "curved tetrahedra"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  EXPECT_TRUE(saved.tissues.at(0).fixed.empty());
  ASSERT_EQ(saved.tissues.at(0).probed.size(), 1u);
  EXPECT_NEAR(saved.tissues[0].probed[0].radius, 0.0015, 1e-9);
}

TEST_F(EditorWindow, AMeniscusOfTheLibraryIsAddedByAClickTornAndSaved) {
  Drive(R"(
click Tissue
click Library
wait frames 20
click "Medial meniscus"
wait job
expect "lies on the relief"
click Cut
click "Tears of a meniscus"
wait frames 3
click "Make this tear"
expect "Longitudinal tear of"
click Undo
click Redo
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  const Tissue& meniscus = saved.tissues.back();
  EXPECT_TRUE(meniscus.name.starts_with("medial meniscus")) << meniscus.name;
  EXPECT_FALSE(meniscus.mesh.empty());
  EXPECT_EQ(meniscus.cuts.size(), 1u);
  EXPECT_EQ(meniscus.regions.size(), 3u);
}

TEST_F(EditorWindow, ATissueIsMadeASolidThatDoesNotGiveWayAndThatIsUndone) {
  Drive(R"(
click Tissue
click Mesh
expect "no tetrahedra yet"
click "A solid that does not give way"
expect "a solid"
expect not "no tetrahedra yet"
click Undo
expect "no tetrahedra yet"
click Redo
expect "a solid"
click Save
wait job
expect "Saved in"
)");
  EXPECT_TRUE(ReadScene(scene).tissues.at(0).is_implicit);
}

TEST_F(EditorWindow, AClickInTheOverviewHoldsTheTissueThereAndIsUndone) {
  Drive(R"(
click Tissue
set "Position (right, down, in), down" 3
set "Position (right, down, in), in" 22.5
click Hold
expect "Nothing holds this tissue"
click "Hold it here…"
wait frames 3
click Overview
wait frames 3
expect "1 ball hold"
expect value "Ball 1" on
set "Radius of this ball" 3
click "Hold it at the instrument"
expect "2 balls hold it."
click Undo
expect "1 ball hold"
click Save
wait job
expect "Saved in"
)");
  const Scene saved = ReadScene(scene);
  ASSERT_EQ(saved.tissues.at(0).fixed.size(), 1u);
  const Ball& ball = saved.tissues[0].fixed[0];
  EXPECT_NEAR(ball.radius, 0.003, 1e-9);
  // On the octahedron of 6 mm: |x| + |y| + |z| is its radius all over its surface.
  EXPECT_NEAR(std::abs(ball.centre.x) + std::abs(ball.centre.y) + std::abs(ball.centre.z), 0.006,
              1e-6);
}

TEST_F(EditorWindow, ATearABiteAndARegionAreClickedInTheOverviewAndPractised) {
  Drive(R"(
click Tissue
set "Position (right, down, in), down" 3
set "Position (right, down, in), in" 22.5
click Cut
expect "Make them on the Mesh page first"
click Mesh
click "Make tetrahedra"
wait job
click Hold
set "Radius of the next ball" 6
click "Hold it here…"
click Overview
expect "1 ball hold"
click Cut
expect "Whole. A trainee begins with what you cut here."
wheel Overview 3
click "Tear…"
click Overview -8 0
expect "Now click where the tear goes on."
expect disabled Redo
click Overview 0 2
expect "Tear octahedron"
expect value "Tear 1" on
click Overview 8 0
expect "Lengthen a tear of octahedron"
click Undo
expect value "Tear 1" on
key ctrl+y
set "Tear depth" 3
expect value "Tear depth" "3.0 mm"
click "Bite…"
click Overview 0 8
expect value "Bite 2" on
set "Bite radius" 1.2
click "Remove this cut"
expect not "Bite 2"
click Undo
expect value "Bite 2" off
click "Region…"
click Overview -4 0
click "Region name"
key ctrl+a
type horn
key enter
expect value horn on
set "Region radius" 4
click Save
wait job
expect "Saved in"
click Practise
wait job
wait frames 10
expect "0.0 mm³ removed"
)");
  const Tissue saved = ReadScene(scene).tissues.at(0);
  ASSERT_EQ(saved.cuts.size(), 2u);
  const auto& tear = std::get<TearCut>(saved.cuts[0]);
  EXPECT_EQ(tear.path.size(), 3u);
  EXPECT_NEAR(tear.depth, 0.003, 1e-9);
  for (const glm::dvec3& x : tear.path)  // on the octahedron of 6 mm
    EXPECT_LT(std::abs(x.x) + std::abs(x.y) + std::abs(x.z), 0.006 + 1e-6);
  EXPECT_NEAR(std::get<CapsuleCut>(saved.cuts[1]).radius, 0.0012, 1e-9);
  ASSERT_EQ(saved.regions.size(), 1u);
  EXPECT_EQ(saved.regions[0].name, "horn");
  EXPECT_NEAR(saved.regions[0].ball.radius, 0.004, 1e-9);
}

TEST_F(EditorWindow, TheAuthorPokesInTheirOwnViewAndAnEditEndsIt) {
  Drive(R"(
click Tissue
click "Poke it"
wait job
wait frames 5
expect "instruments cause harm above 8.5 N"
expect value "Poke it" on
drag Picture 20 0 right
wait frames 5
set "Position (right, down, in), in" 25
wait frames 3
expect not "instruments cause harm above 8.5 N"
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

TEST_F(EditorWindow, AClickInTheScopesPictureHoldsTheTissueAndAMissIsToldAndEscLeaves) {
  Drive(R"(
click Portals
click "0°"
click Tissue
set "Position (right, down, in), down" 0
set "Position (right, down, in), in" 26
click Hold
click "Hold it here…"
wait frames 3
click Picture 0 -190
wait frames 3
expect "1 ball hold"
click Picture
wait frames 3
expect "There is no tissue at that place"
expect "1 ball hold"
key escape
wait frames 3
expect "The overview turns and moves again."
click Picture 0 -190
wait frames 3
expect "1 ball hold"
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

TEST_F(EditorWindow, TheNameOfASceneIsTypedAtOnceAndEnterSaves) {
  Drive(R"(
key ctrl+shift+s
wait frames 5
type )" +
        (temp / "typed").string() +
        R"(
key enter
wait job
expect "Saved in"
)");
  EXPECT_TRUE(std::filesystem::exists(temp / "typed/scene.json"));
}

TEST_F(EditorWindow, TheHistoryGoesBackByAClick) {
  Drive(R"(
click Portals
set "Incision spacing" -25
set "Length of the scope" 210
key ctrl+h
wait frames 3
expect "1  Change the incision spacing"
click "0  Open"
wait frames 3
click Close
wait frames 3
expect value "Incision spacing" "30.0 mm"
expect disabled Undo
key ctrl+h
wait frames 3
click "Snapshot's name"
type "Before the tear"
click "Keep snapshot"
wait job
expect "Kept the snapshot"
)");
}

TEST_F(EditorWindow, ABrokenFileIsToldAndTheSceneStays) {
  std::ofstream(temp / "broken.png") << "no picture";
  Drive("drop " + (temp / "broken.png").string() +
        "\nwait job\nexpect broken.png\nclick OK\nexpect \"Small knee\"\nexpect disabled Undo\n");
}

TEST_F(EditorWindow, TheSameScriptGivesTheSamePicture) {
  const std::string shots[] = {(temp / "a.png").string(), (temp / "b.png").string()};
  for (const auto& shot : shots) Drive("drag Picture 40 20\nwheel Picture 2\nshot " + shot);
  EXPECT_EQ(ReadColourImage(shots[0]).rgb, ReadColourImage(shots[1]).rgb);
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

TEST_F(EditorWindow, AFailedExpectationIsToldWithItsLine) {
  const auto result = RunWindow("edit " + scene.string(), "click Portals\nexpect \"purple\"\n");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("line 2"), std::string::npos) << result.err;
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

TEST(NoDisplay, IsSaidInOneSentenceThatNamesTheWayOut) {
  const auto result = test::RunProgram("edit", "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("there is no display"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("arthroscene demo"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace arthro
