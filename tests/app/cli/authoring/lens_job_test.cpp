// Jobs lens and rectify, run as a user runs them.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/run_program.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

class LensJob : public ::testing::Test {
 protected:
  std::string At(const char* name) const { return (folder_ / name).string(); }
  test::ProgramResult Lens(const std::string& pictures) const {
    return test::RunProgram("lens " + pictures + " --spacing-mm 2 -o " + At("lens.json"));
  }
  // A lens for pictures of 96 x 64.
  void WriteSmallLens() const {
    arthro::Lens lens;
    lens.width = 96;
    lens.height = 64;
    lens.focal_px = 60;
    lens.cx = 47.5;
    lens.cy = 31.5;
    lens.circle = {47.5, 31.5, 30};
    lens.field_of_view = *FieldOfViewOf(lens);
    WriteLens(folder_ / "small.json", lens);
  }
  test::TempFolder folder_;
};

TEST_F(LensJob, BadPicturesGiveOneSentenceAndNoLens) {
  WriteColourImage(folder_ / "a.png", ColourImage(96, 96));
  WriteColourImage(folder_ / "b.png", ColourImage(128, 96));
  WriteAtomically(folder_ / "empty.png", "");
  struct Case {
    std::string pictures, says;
  };
  for (const Case& c : {Case{At("none.png"), "none.png"}, Case{At("empty.png"), "empty.png"},
                        Case{At("a.png"), "no line grid, chessboard or dot grid"},
                        Case{At("a.png") + " " + At("a.png"), "no picture shows"},
                        Case{At("a.png") + " " + At("b.png"), "128 x 96"}}) {
    const test::ProgramResult run = Lens(c.pictures);
    EXPECT_EQ(run.exit_code, 1) << c.pictures;
    EXPECT_NE(run.err.find(c.says), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder_ / "lens.json"));
  }
  EXPECT_EQ(test::RunProgram("lens " + At("a.png") + " -o x.json").exit_code, 2);
  EXPECT_EQ(
      test::RunProgram("lens " + At("a.png") + " --spacing-mm 0 -o " + At("x.json")).exit_code, 2);
}

TEST_F(LensJob, RectifyWritesAWholeFolderOrNone) {
  WriteSmallLens();
  fs::create_directories(folder_ / "frames");
  WriteColourImage(folder_ / "frames" / "0.png", test::KneePicture(96, 64));
  WriteColourImage(folder_ / "frames" / "1.png", test::KneePicture(96, 64));
  const std::string with = "rectify " + At("frames") + " --lens " + At("small.json") + " -o ";
  const test::ProgramResult run = test::RunProgram(with + At("flat"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(ReadColourImage(folder_ / "flat" / "000001.png").width, 58);  // 2 x 29 px and a border
  // Not over what is there.
  EXPECT_EQ(test::RunProgram(with + At("flat")).exit_code, 1);
  // A frame of another size ends it, and nothing is left behind.
  WriteColourImage(folder_ / "frames" / "2.png", ColourImage(64, 64));
  const test::ProgramResult mixed = test::RunProgram(with + At("other"));
  EXPECT_EQ(mixed.exit_code, 1);
  EXPECT_NE(mixed.err.find("64 x 64"), std::string::npos) << mixed.err;
  EXPECT_FALSE(fs::exists(folder_ / "other"));
  EXPECT_FALSE(fs::exists(folder_ / "other.partial"));
  EXPECT_EQ(
      test::RunProgram("rectify " + At("frames") + " --lens " + At("no.json") + " -o " + At("x"))
          .exit_code,
      1);
}

}  // namespace
}  // namespace arthro
