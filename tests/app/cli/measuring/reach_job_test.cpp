// Suggestions of the reach job, through the program itself.
#include <gtest/gtest.h>

#include "tests/support/build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

ProgramResult Reach(const TempFolder& folder, const std::string& flags) {
  return RunProgram("reach " ARTHRO_SOURCE_DIR "/resources/demo " + flags + " --overwrite -o " +
                    (folder / "reach.csv").string());
}

TEST(ReachJob, SuggestsASpacingForOneTargetOrForSeveral) {
  const TempFolder folder;
  EXPECT_EQ(Reach(folder, "").out, "");
  const std::string one = Reach(folder, "--suggest relief").out;
  EXPECT_TRUE(one.starts_with("suggested incision spacing for relief: ")) << one;
  const ProgramResult several =
      Reach(folder, "--suggest \"medial meniscus\" --suggest \"measure: left\" --suggest relief");
  EXPECT_EQ(several.exit_code, 0) << several.err;
  EXPECT_TRUE(several.out.starts_with(
      "suggested incision spacing for medial meniscus, measure: left, relief: "))
      << several.out;
}

TEST(ReachJob, ATargetThatIsNotThereIsRefusedWithThoseThatAre) {
  const TempFolder folder;
  const ProgramResult run = Reach(folder, "--suggest \"lateral meniscus\"");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("there is no target \"lateral meniscus\"; name some of: relief, medial "
                         "meniscus"),
            std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "reach.csv"));
}

}  // namespace
}  // namespace arthro::test
