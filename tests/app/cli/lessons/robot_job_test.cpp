// arthroscene robot: attempts at exercises of the demo scene, as a researcher makes them by a
// script.
#include <filesystem>

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
  EXPECT_NE(novice.out.find("not met  Time: "), std::string::npos) << novice.out;
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

TEST(RobotJob, KeepsItsAttemptWhoseReportHasPictures) {
  const test::TempFolder folder;
  const std::string place = " --records " + (folder / "records.sqlite").string();
  const std::string robot = "robot " + kDemo + " --exercise telescope --trainee R-1" + place;
  const auto unknown = test::RunProgram(robot);
  EXPECT_EQ(unknown.exit_code, 1) << "no trainee has the code yet";
  ASSERT_EQ(test::RunProgram("records trainee add R-1" + place).exit_code, 0);
  const auto kept = test::RunProgram(robot);
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  const std::string words = "Kept for R-1 as attempt ";
  const auto at = kept.out.find(words);
  ASSERT_NE(at, std::string::npos) << kept.out;
  const std::string id = kept.out.substr(at + words.size(), 36);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find("robot-"), std::string::npos) << "left behind: " << entry;
  const auto page = [&](const std::string& name, const std::string& flags) {
    const auto file = folder / name;
    const auto shown =
        test::RunProgram("records show " + id + place + " --report " + file.string() + " " + flags);
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    return ReadWholeFile(file);
  };
  const std::string with = page("with.html", "--scene " + kDemo);
  EXPECT_NE(with.find("src=\"data:image/jpeg"), std::string::npos);
  EXPECT_EQ(page("found.html", ""), with) << "the demo scene is found";
  EXPECT_EQ(page("without.html", "--no-pictures").find("src="), std::string::npos);
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
