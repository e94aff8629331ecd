// Scenes in the window: saved, named, closed, opened and taken back through the history.
#include <filesystem>

#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/app/editor/editor_window.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using test::EditorWindow;

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

}  // namespace
}  // namespace arthro
