// An incision calibrated, and the validation figure saved, as their users do it: scripts click by
// name, hold keys and look (app/platform/script/script.h).
#include <filesystem>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/rig_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/moved_rig.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using test::RunWindow;

class IncisionWindow : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = test::WriteSmallScene(temp / "knee", false);
    rig = temp / "rig.json";
    WriteAtomically(rig, test::kMovedRig);
  }
  // A failed script tells its line on stderr.
  void Drive(const std::string& script, const std::string& flags) {
    const auto result = RunWindow("edit " + scene.string() + " " + flags, script, "1280x800x24");
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  double Moved() const { return glm::distance(ReadRig(rig).scope->mount.pivot, test::kMovedPivot); }
  test::TempFolder temp;
  fs::path scene, rig;
};

// In the middle of the range; 110 frames of a key are 37 degrees.
constexpr const char* kBegin = R"(
click Practice
click Devices
click "Calibrate scope incision…"
wait job
wait frames 60
expect "Incision of the scope"
expect "No device gets a force during calibration."
expect disabled "Use this incision"
)";

TEST_F(IncisionWindow, TwoPressesAreTakenOverAndSavedInTheRig) {
  Drive(std::string(kBegin) + R"(
expect value Presses "0"
click Press
wait frames 12
expect value Presses "1"
expect disabled "Use this incision"
hold right 110
wait frames 60
key b
wait frames 12
expect value Presses "2"
expect "This incision can be used."
click "Use this incision"
expect "In use, and saved in"
wait frames 5
key escape
expect "simulated device"
expect not "Incision of the scope"
key escape
expect "Practice left."
)",
        "--hands plant --rig " + rig.string());
  // Predicted error: a rounding of 0.055 mm leaves 0.05 mm or less for presses 37 degrees apart.
  EXPECT_LT(Moved(), 3 * 0.05e-3);
  EXPECT_GT(Moved(), 0) << "what was found, not what was there";
  EXPECT_NE(ReadWholeFile(rig).find("x-room"), std::string::npos);
}

TEST_F(IncisionWindow, PressesThatAreTooNarrowAreRefusedInWords) {
  Drive(std::string(kBegin) + R"(
key b
wait frames 12
hold right 12
wait frames 60
key b
wait frames 12
expect value Presses "2"
expect "degrees apart in direction"
expect disabled "Use this incision"
click "Begin again"
expect value Presses "0"
)",
        "--hands plant --rig " + rig.string());
  EXPECT_EQ(ReadWholeFile(rig), test::kMovedRig);
}

TEST_F(IncisionWindow, ASwingIsFittedWhileItGoesOn) {
  Drive(std::string(kBegin) + R"(
click "Keep swinging"
expect "keep swinging the rod"
hold right 100
hold up 80
hold left 200
hold down 160
hold right 100
wait frames 20
wait job
wait frames 2
expect "This incision can be used."
click "Use this incision"
expect "In use, and saved in"
)",
        "--hands plant --rig " + rig.string());
  EXPECT_LT(Moved(), 3 * 0.05e-3);
  EXPECT_GT(Moved(), 0);
}

TEST_F(IncisionWindow, ARigThatCameWithTheProgramStaysAsItIsAndIsSavedElsewhere) {
  const fs::path shipped =
      fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/rigs/woodenhaptics_instrument.json";
  const std::string text = ReadWholeFile(shipped), own = (temp / "mine.json").string();
  Drive(R"(
key p
wait job
key f4
click "Calibrate instrument incision…"
wait frames 60
key b
wait frames 12
hold d 110
wait frames 60
key b
wait frames 12
click "Use this incision"
expect "came with the program"
click "Save rig as…"
set "File name" ")" +
            (temp / "nowhere" / "mine.json").string() +
            R"("
wait frames 3
expect not "saved in"
key escape
wait frames 3
click "Save rig as…"
set "File name" ")" +
            own + R"("
expect "In use, and saved in"
)",
        "--hands plant --rig " + shipped.string());
  EXPECT_EQ(ReadWholeFile(shipped), text);
  const RigFile before = ReadRig(shipped), after = ReadRig(own);
  EXPECT_NE(after.instrument->mount.pivot, before.instrument->mount.pivot);
  EXPECT_LT(glm::distance(after.instrument->mount.pivot, before.instrument->mount.pivot), 0.15e-3);
}

// The same table as the job's, and both pictures.
TEST_F(IncisionWindow, TheValidationPlotOfTheOpenSceneIsThatOfTheJob) {
  const std::string script = R"(
click Practice
click Devices
click "Validation plot…"
set "File name" ")" + (temp / "fig7.png").string() +
                             R"("
wait job
)";
  Drive(script + "expect \"Validation plot: \"\n", "");
  const auto job =
      test::RunProgram("centres " + scene.string() + " -o " + (temp / "job.csv").string() +
                       " --picture " + (temp / "job.png").string());
  ASSERT_EQ(job.exit_code, 0) << job.err;
  EXPECT_EQ(ReadWholeFile(temp / "fig7.csv"), ReadWholeFile(temp / "job.csv"));
  EXPECT_EQ(ReadColourImage(temp / "fig7.png").rgb, ReadColourImage(temp / "job.png").rgb);
  EXPECT_NE(ReadColourImage(temp / "fig7-grid.png").rgb, ReadColourImage(temp / "job.png").rgb);
  // Nothing beside it is overwritten unasked.
  fs::remove(temp / "fig7.png");
  Drive(script + "expect \"is already there\"\n", "");
  EXPECT_FALSE(fs::exists(temp / "fig7.png"));
}

}  // namespace
}  // namespace arthro
