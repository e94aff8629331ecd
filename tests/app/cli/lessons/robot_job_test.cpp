// arthroscene robot: attempts at exercises of the demo scene, as a researcher makes them by a
// script.
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_program.h"

namespace arthro {
namespace {

const std::string kDemo = ARTHRO_SOURCE_DIR "/resources/demo";

TEST(RobotJob, MakesTheSameAttemptForTheSameSeedAndAssessAgrees) {
  const test::TempFolder folder;
  const auto robot = [&](const std::string& file, const std::string& flags) {
    return test::RunProgram("robot " + kDemo + " --exercise telescope -o " +
                            (folder / file).string() + " " + flags);
  };
  const auto first = robot("a.attempt", "--seed 2 --require-pass");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(first.out.starts_with("passed after")) << first.out;
  EXPECT_EQ(robot("b.attempt", "--seed 2").exit_code, 0);
  EXPECT_EQ(robot("c.attempt", "--seed 3").exit_code, 0);
  const std::string bytes = ReadWholeFile(folder / "a.attempt");
  EXPECT_EQ(ReadWholeFile(folder / "b.attempt"), bytes);
  EXPECT_NE(ReadWholeFile(folder / "c.attempt"), bytes);
  const auto assessed = test::RunProgram("assess " + kDemo + " " + (folder / "a.attempt").string() +
                                         " --exercise telescope --require-pass");
  EXPECT_EQ(assessed.exit_code, 0) << assessed.err;
  // An attempt that exists is not replaced without being asked.
  const auto again = robot("a.attempt", "--seed 3");
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.err.find("--overwrite"), std::string::npos) << again.err;
  EXPECT_EQ(ReadWholeFile(folder / "a.attempt"), bytes);
}

TEST(RobotJob, ANoviceMissesTheCriterionOfItsFault) {
  const auto novice =
      test::RunProgram("robot " + kDemo + " --exercise telescope --fault too-slow --require-pass");
  EXPECT_EQ(novice.exit_code, 1);
  EXPECT_NE(novice.out.find("not met  task_time"), std::string::npos) << novice.out;
  EXPECT_NE(novice.err.find("--require-pass"), std::string::npos) << novice.err;
}

// A fault that finds no place in the exercise, as a body that is dropped where there is none.
TEST(RobotJob, SaysThatNoCriterionShowsTheFault) {
  const auto run = test::RunProgram("robot " + kDemo + " --exercise centre-and-hold --fault drops");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("no criterion of centre-and-hold shows the fault drops"),
            std::string::npos)
      << run.err;
}

TEST(RobotJob, RefusesWhatIsNotThere) {
  const auto unknown = test::RunProgram("robot " + kDemo + " --exercise none");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("it has centre-and-hold, telescope"), std::string::npos);
  EXPECT_EQ(test::RunProgram("robot " + kDemo + " --exercise track --fault lazy").exit_code, 2);
  EXPECT_EQ(test::RunProgram("robot " + kDemo).exit_code, 2);
}

}  // namespace
}  // namespace arthro
