// A session of mouse and keys is written down as a script, and the job `run` repeats it.
#include <algorithm>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/input_file.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

class RecordedSession : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = test::WriteSmallScene(temp / "knee");
  }
  static std::map<std::string, std::string> FilesOf(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(folder).string()] = ReadWholeFile(entry.path());
    return files;
  }
  // Does `acts` in a window, saves the scene as "made", and gives the script that was recorded.
  std::string Record(const std::string& acts) {
    const auto result =
        test::RunWindow("edit " + scene.string(), "do record-script\n" + acts + "do save-as " +
                                                      (temp / "made").string() + "\nwait job\n" +
                                                      "do end-script " + script().string() + "\n");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return ReadWholeFile(script());
  }
  // Repeats the script without a display and expects the same bytes.
  void ExpectTheSameScene() {
    fs::rename(temp / "made", temp / "by hand");
    const auto again =
        test::RunProgram("run " + script().string(),
                         "env -u DISPLAY -u WAYLAND_DISPLAY HOME=" + temp.path().string() +
                             " LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1");
    ASSERT_EQ(again.exit_code, 0) << again.err << ReadWholeFile(script());
    EXPECT_EQ(FilesOf(temp / "made"), FilesOf(temp / "by hand"));
  }
  fs::path script() const { return temp / "session.script"; }

  test::TempFolder temp;
  fs::path scene;
};

TEST_F(RecordedSession, OfSlidersFieldsAndUndoGivesTheSameBytes) {
  const std::string recorded = Record(R"(
click Portals
drag "Field of view" 40 0
set "Incision spacing" 22
key ctrl+z
key ctrl+y
click Panorama
set Title "Right \"knee\" # 2"
click Depth
click "Make depth from the picture"
wait job
set "Near relief" 12
wait job
)");
  for (const char* line :
       {"\ndo step-portals\n", "\nset \"Field of view\" ", "\nset \"Incision spacing\" 22.0\n",
        "\ndo undo\n", "\ndo redo\n", "\nset Title \"Right \\\"knee\\\" # 2\"\n",
        "\ndo make-depth\nwait job\n", "\ndo save-as\nchoose "})
    EXPECT_NE(recorded.find(line), std::string::npos) << line << recorded;
  ExpectTheSameScene();
  const Scene made = ReadScene(temp / "made");
  EXPECT_EQ(made.title, "Right \"knee\" # 2");
}

TEST_F(RecordedSession, OfDragsOverThePicturesGivesTheSameBytes) {
  const std::string recorded = Record(R"(
click Tissue
drag Picture 60 25
wheel Picture 2
drag Overview 40 12 right
wheel Overview 1
drag Handle 46 -20
wait frames 3
drag Handle 20 30 right
click "Hold"
click "Hold it at the instrument"
hold w 10
drag Overview -30 40
drag Handle -12 18
)");
  // The scope's swing is its pose; the overview's drags are strokes from its middle.
  EXPECT_NE(recorded.find("\npose scope 0."), std::string::npos) << recorded;
  EXPECT_NE(recorded.find("\nstroke Overview "), std::string::npos) << recorded;
  EXPECT_EQ(recorded.find("\nstroke Picture "), std::string::npos) << recorded;
  ExpectTheSameScene();
}

TEST_F(RecordedSession, ThatFailsNamesTheLine) {
  WriteAtomically(script(), "resize 1280 800\ndo fly\n");
  const auto unknown = test::RunProgram("run " + script().string(), "env -u DISPLAY");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("script line 2: there is no command \"fly\""), std::string::npos)
      << unknown.err;
  WriteAtomically(script(), "fly\n");
  const auto wrong = test::RunProgram("run " + script().string(), "env -u DISPLAY PATH=/nowhere");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("script line 1"), std::string::npos) << wrong.err;
}

// The program ended while its last work was under way, and without a word of the message that
// nobody could read.
TEST_F(RecordedSession, EndsAfterItsLastWorkAndFailsWithAMessageThatIsOpen) {
  const auto run = [&](const std::string& line) {
    WriteAtomically(script(), "do open " + scene.string() + "\nwait job\n" + line + "\n");
    return test::RunProgram("run " + script().string(),
                            "env -u DISPLAY -u WAYLAND_DISPLAY HOME=" + temp.path().string() +
                                " LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1");
  };
  const auto saved = run("do save-as " + (temp / "made").string());
  EXPECT_EQ(saved.exit_code, 0) << saved.err;
  EXPECT_TRUE(fs::exists(temp / "made" / "scene.json"));
  WriteAtomically(temp / "broken.png", "no picture");
  const auto broken = run("do import-panorama " + (temp / "broken.png").string());
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_NE(broken.err.find("broken.png"), std::string::npos) << broken.err;
}

TEST_F(RecordedSession, WithoutADisplayAndXvfbSaysWhatToInstall) {
  WriteAtomically(script(), "quit\n");
  const auto result = test::RunProgram("run " + script().string(),
                                       "env -u DISPLAY -u WAYLAND_DISPLAY PATH=/nowhere");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("install the package xvfb"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(RunJob, ListsEveryCommandByName) {
  const auto list = test::RunProgram("run --list", "env -u DISPLAY");
  EXPECT_EQ(list.exit_code, 0) << list.err;
  for (const char* id : {"save-as ", "make-depth ", "practise ", "record-script "})
    EXPECT_NE(list.out.find(id), std::string::npos) << id;
}

}  // namespace
}  // namespace arthro
