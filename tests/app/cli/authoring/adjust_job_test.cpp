// The adjust job on the small scene: what its flags say is what the scene becomes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/app/cli/job_inputs.h"
#include "tests/support/run_program.h"

namespace arthro::test {
namespace {

class AdjustJob : public JobInputs {
 protected:
  ProgramResult Adjust(const std::string& from, const std::string& to,
                       const std::string& flags) const {
    return RunProgram(Whole("adjust @" + from + " -o @" + to + " " + flags));
  }
};

TEST_F(AdjustJob, MirroredTwiceIsTheSameScene) {
  ASSERT_EQ(Adjust("S", "first", "--side right").exit_code, 0);
  ASSERT_EQ(Adjust("first", "once", "--mirror").exit_code, 0);
  ASSERT_EQ(Adjust("once", "twice", "--mirror").exit_code, 0);
  EXPECT_EQ(LoadScene(At("once")).scene.side, BodySide::kLeft);
  for (const char* file : {"scene.json", "panorama.png", "depth.tiff"})
    EXPECT_EQ(ReadWholeFile(At("twice") + "/" + file), ReadWholeFile(At("first") + "/" + file))
        << file;
}

TEST_F(AdjustJob, CropsScalesAndTurns) {
  const LoadedScene before = LoadScene(At("S"));
  // Right of the middle of the projection, exactly.
  const glm::dvec2 middle = before.scene.backdrop.projection.centre_px;
  const std::string up =
      fmt::format("--up {},{}:{},{}", middle.x, middle.y, middle.x + 60, middle.y);
  const ProgramResult run =
      Adjust("S", "A", "--crop 100,50,200,150 --length-mm 30 --between 150,150:250,150 " + up);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const LoadedScene after = LoadScene(At("A"));
  EXPECT_EQ(after.panorama->width, 200);
  EXPECT_NE(after.scene.backdrop.radius, before.scene.backdrop.radius);
  EXPECT_NEAR(after.scene.backdrop.projection.roll, RadiansFromDegrees(-90), 1e-9);
  EXPECT_NE(run.out.find("cropped to 200 x 150 px"), std::string::npos) << run.out;
}

TEST_F(AdjustJob, AnArchiveThatExistsIsReplacedWithOverwriteAlone) {
  const std::string archive = At("A.arthro");
  ASSERT_EQ(Adjust("S", "A.arthro", "--side right").exit_code, 0);
  const std::string first = ReadWholeFile(archive);
  const ProgramResult refused = Adjust("S", "A.arthro", "--side left");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("this scene exists"), std::string::npos) << refused.err;
  EXPECT_EQ(ReadWholeFile(archive), first);
  const ProgramResult replaced = Adjust("S", "A.arthro", "--side left --overwrite");
  EXPECT_EQ(replaced.exit_code, 0) << replaced.err;
  EXPECT_EQ(LoadScene(archive).scene.side, BodySide::kLeft);
}

TEST_F(AdjustJob, RefusesInOneSentenceAndWritesNothing) {
  for (const char* flags : {"", "--crop 300,0,200,100", "--length-mm 10", "--medial 1,1:50,1",
                            "--up 5,5:5,5", "--crop 1,2,3"}) {
    const ProgramResult run = Adjust("S", "A", flags);
    EXPECT_NE(run.exit_code, 0) << flags;
    EXPECT_FALSE(std::filesystem::exists(At("A"))) << flags;
  }
}

}  // namespace
}  // namespace arthro::test
