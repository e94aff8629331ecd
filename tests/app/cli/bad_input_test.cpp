// Bad input gets one clear sentence on stderr and exit 1; nothing is overwritten and nothing
// crashes.
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"
#include "tests/support/wavy_picture.h"

namespace arthro {
namespace {

using test::ProgramResult;
using test::RunProgram;
using test::TempFolder;
using test::WavyPicture;

namespace fs = std::filesystem;

const char* const kOldBytes = "what was here before";

// A scene that is right in every part, as text and files.
void MakeScene(const fs::path& folder) {
  WriteColourImage(folder / "panorama.png", WavyPicture(200, 150));
  WriteDepthMap(folder / "depth.tiff", DepthMap(200, 150, 0.01f));
  WriteAtomically(folder / "scene.json", R"({"schema": "arthroscene.scene/1", "title": "t",
    "backdrop": {"panorama": "panorama.png", "depth": "depth.tiff", "radius": 0.05,
                 "projection": {"type": "gnomonic", "centre_px": [100, 75], "focal_px": 120}}})");
}

void ReplaceIn(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = ReadWholeFile(file);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  WriteAtomically(file, text.replace(at, from.size(), to));
}

// The job refuses with exit 1, one line on stderr that holds `word`, and leaves `output` as it was.
void ExpectRefusal(const std::string& arguments, const std::string& word, const fs::path& output,
                   const std::string& environment = "") {
  WriteAtomically(output, kOldBytes);
  const ProgramResult result = RunProgram(arguments + " --overwrite", environment);
  EXPECT_EQ(result.exit_code, 1) << arguments << "\n" << result.err;
  EXPECT_NE(result.err.find(word), std::string::npos)
      << "wanted \"" << word << "\" in: " << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(ReadWholeFile(output), kOldBytes) << arguments;
}

TEST(BadInput, MissingPicture) {
  TempFolder folder;
  ExpectRefusal("depth " + (folder / "none.png").string() + " -o " + (folder / "d.tiff").string(),
                "none.png", folder / "d.tiff");
}

TEST(BadInput, TruncatedPicture) {
  TempFolder folder;
  WriteColourImage(folder / "a.png", WavyPicture(200, 150));
  std::string bytes = ReadWholeFile(folder / "a.png");
  WriteAtomically(folder / "a.png", bytes.substr(0, bytes.size() / 2));
  ExpectRefusal("depth " + (folder / "a.png").string() + " -o " + (folder / "d.tiff").string(),
                "cut off", folder / "d.tiff");
}

TEST(BadInput, PanoramaAndDepthOfDifferentSizes) {
  TempFolder folder;
  MakeScene(folder.path());
  WriteDepthMap(folder / "depth.tiff", DepthMap(64, 64, 0.01f));
  WriteAtomically(folder / "trace.csv",
                  "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n0,scope,0,0,-0.17,1,0,0,0,0\n");
  ExpectRefusal("replay " + folder.path().string() + " " + (folder / "trace.csv").string() +
                    " -o " + (folder / "f.csv").string(),
                "64 x 64", folder / "f.csv");
}

TEST(BadInput, SceneOfANewerSchema) {
  TempFolder folder;
  MakeScene(folder.path());
  ReplaceIn(folder / "scene.json", "arthroscene.scene/1", "arthroscene.scene/99");
  ExpectRefusal("centres " + folder.path().string() + " --view-angle-deg 30 --insertion-mm 5 -o " +
                    (folder / "c.csv").string(),
                "arthroscene.scene/99", folder / "c.csv");
}

TEST(BadInput, NotANumberInATrace) {
  TempFolder folder;
  MakeScene(folder.path());
  WriteAtomically(folder / "trace.csv",
                  "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                  "0,scope,0,0,-0.17,1,0,0,0,0\n0.01,scope,nan,0,-0.17,1,0,0,0,0\n");
  ExpectRefusal("replay " + folder.path().string() + " " + (folder / "trace.csv").string() +
                    " -o " + (folder / "f.csv").string(),
                "line 3", folder / "f.csv");
}

TEST(BadInput, ADamagedDeviceLog) {
  TempFolder folder;
  MakeScene(folder.path());
  // Its name says nothing; that it begins as a log does.
  WriteAtomically(folder / "trace.csv", std::string("ARTHRLOG\1\0\0\0", 12) + std::string(64, 'x'));
  ExpectRefusal("replay " + folder.path().string() + " " + (folder / "trace.csv").string() +
                    " -o " + (folder / "f.csv").string(),
                "block at byte 12 is damaged", folder / "f.csv");
}

TEST(BadInput, ReplayOverTheSceneThatItPlaysIn) {
  TempFolder folder;
  MakeScene(folder.path());
  WriteAtomically(folder / "trace.csv",
                  "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n0,scope,0,0,-0.17,1,0,0,0,0\n");
  const auto in = [&](const char* name) { return (folder.path() / name).string(); };
  const std::string replay = "replay " + folder.path().string() + " " + in("trace.csv") + " -o ";
  for (const char* name : {"scene.json", "panorama.png", "depth.tiff", "trace.csv"}) {
    const std::string before = ReadWholeFile(in(name));
    ExpectRefusal(replay + in(name) + " --report " + in("r.json"), "overwrite", in("r.json"));
    ExpectRefusal(replay + in("f.csv") + " --report " + in(name), "overwrite", in("f.csv"));
    EXPECT_EQ(ReadWholeFile(in(name)), before) << name;
  }
  ExpectRefusal(replay + in("f.csv") + " --report " + in("./f.csv"), "this one file", in("f.csv"));
  ExpectRefusal(replay + in("f.csv") + " --report " + in("none/r.json"), "does not exist",
                in("f.csv"));
  // Pictures go into a folder: no file's name, and it is not made for nothing.
  ExpectRefusal(replay + in("f.csv") + " --pictures " + in("f.csv"), "this is a file", in("f.csv"));
  const ProgramResult both = RunProgram(replay + in("new") + " --pictures " + in("new"));
  EXPECT_EQ(both.exit_code, 1);
  EXPECT_NE(both.err.find("both as a file and as a folder"), std::string::npos) << both.err;
  EXPECT_FALSE(fs::exists(in("new")));
}

// A box of `size` with or without its lid.
void WriteBox(const fs::path& file, double size, bool closed) {
  std::ofstream off(file);
  off << "OFF\n8 " << (closed ? 12 : 10) << " 0\n";
  for (int i = 0; i < 8; ++i)
    off << size * (i & 1) << ' ' << size * ((i >> 1) & 1) << ' ' << size * (i >> 2) << '\n';
  off << "3 0 2 1\n3 1 2 3\n3 0 1 4\n3 1 5 4\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n3 2 6 3\n3 3 6 "
         "7\n";
  if (closed) off << "3 4 5 6\n3 5 7 6\n";
}

TEST(BadInput, OpenSurface) {
  TempFolder folder;
  WriteBox(folder / "box.off", 10.0, false);
  ExpectRefusal("tetrahedralize " + (folder / "box.off").string() + " --unit mm -o " +
                    (folder / "t.vtu").string(),
                "open", folder / "t.vtu");
}

TEST(BadInput, WrongUnit) {
  TempFolder folder;
  WriteBox(folder / "box.off", 20.0, true);  // 20 mm that are called metres
  ExpectRefusal("tetrahedralize " + (folder / "box.off").string() + " --unit m -o " +
                    (folder / "t.vtu").string(),
                "mm", folder / "t.vtu");
}

TEST(BadInput, NoDisplay) {
  TempFolder folder;
  MakeScene(folder.path());
  for (const std::string job : {"edit ", "practise "})
    ExpectRefusal(job + folder.path().string(), "no display", folder / "untouched",
                  "DISPLAY= WAYLAND_DISPLAY=");
}

// Told before there is a window.
TEST(BadInput, RigAndRecordedHands) {
  TempFolder folder;
  MakeScene(folder.path());
  const auto rig = folder / "rig.json", trace = folder / "trace.csv";
  std::ofstream(rig) << R"({"schema": "arthroscene.rig/1", "title": "t",
                            "scope": {"device": {"family": "joystick"}, "rod_length": 0.2}})";
  std::ofstream(trace) << "time,x\n";
  const std::string practise = "practise " + folder.path().string();
  const fs::path none = folder / "untouched";
  ExpectRefusal(practise + " --rig " + rig.string(), "it must be one of", none, "DISPLAY=");
  const auto model = folder / "model.json";
  std::ofstream(model)
      << R"({"schema": "arthroscene.rig/1", "title": "t", "scope": {"rod_length": 0.2,
                              "device": {"family": "wooden_haptics", "model": "of pine"}}})";
  ExpectRefusal(practise + " --rig " + model.string(), "model is \"of pine\"; it must be one of",
                none, "DISPLAY=");
  ExpectRefusal(practise + " --rig " + none.string(), "untouched", none, "DISPLAY=");
  if (RunProgram("devices --json -").out.find("built without OpenHaptics") != std::string::npos)
    ExpectRefusal(
        practise + " --rig " ARTHRO_SOURCE_DIR "/resources/presets/rigs/touch_instrument.json",
        "touch_instrument.json: instrument: this program was built without OpenHaptics", none,
        "DISPLAY=");
  ExpectRefusal(practise + " --hands " + trace.string(), "neither a log nor a table of hands", none,
                "DISPLAY=");
  ExpectRefusal(practise + " --hands plant --rig " + rig.string(), "it must be one of", none,
                "DISPLAY=");
}

// /dev/full is the kernel's own full disk.
TEST(BadInput, FullDiskWhileWriting) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "SKIPPED: no /dev/full here";
  TempFolder folder;
  WriteColourImage(folder / "a.png", WavyPicture(200, 150));
  const std::string line = ARTHRO_PROGRAM " depth " + (folder / "a.png").string() +
                           " -o - > /dev/full 2> " + (folder / "err").string();
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(ReadWholeFile(folder / "err").find("full"), std::string::npos);
}

// RLIMIT_FSIZE stands in for a disk that fills up half-way through a file.
TEST(BadInput, DiskThatFillsUpLeavesTheOldFile) {
  TempFolder folder;
  WriteColourImage(folder / "a.png", WavyPicture(1200, 900));
  WriteAtomically(folder / "d.tiff", kOldBytes);
  const std::string line = "(ulimit -f 8; trap '' XFSZ; " ARTHRO_PROGRAM " depth " +
                           (folder / "a.png").string() + " --overwrite -o " +
                           (folder / "d.tiff").string() + ") 2> " + (folder / "err").string();
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(ReadWholeFile(folder / "err").find("d.tiff"), std::string::npos);
  EXPECT_EQ(ReadWholeFile(folder / "d.tiff"), kOldBytes);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
}

}  // namespace
}  // namespace arthro
