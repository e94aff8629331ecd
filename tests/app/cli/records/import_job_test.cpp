// records import: one code of two trainees who were added apart is refused until somebody says that
// they are one person.
#include <gtest/gtest.h>

#include "app/records/attempts/records_file.h"
#include "simulation/core/atomic_file.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_attempts.h"

namespace arthro {
namespace {

// Exports one attempt of T-1, who was added in these records.
void Export(const test::TempFolder& folder, const std::string& name, std::uint64_t seed) {
  app::Records records((folder / (name + ".sqlite")).string(), test::RepeatedOptions(seed));
  app::AddTrainee(records, test::NewTrainee("T-1"));
  const auto session = app::StartSession(records, "T-1", "test", "mouse");
  test::Attempt(records, session, test::SampleExercise());
  WriteAtomically(folder / (name + ".json"), app::RecordsText(app::ReadBundle(records)));
}

TEST(ImportJob, RefusesOneCodeOfTwoTraineesUntilTheyAreSaidToBeOne) {
  const test::TempFolder folder;
  Export(folder, "here", 1);
  Export(folder, "there", 2);
  const std::string import = "records import " + (folder / "there.json").string() + " --records " +
                             (folder / "here.sqlite").string();
  const auto refused = test::RunProgram(import);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("T-1 stands here and in this file for trainees who were added apart"),
            std::string::npos)
      << refused.err;
  const auto joined = test::RunProgram(import + " --same-trainees");
  EXPECT_EQ(joined.exit_code, 0) << joined.err;
  EXPECT_EQ(joined.out, "1 attempts are new, 0 were there already\n");
  const auto again = test::RunProgram("records import " + (folder / "here.json").string() +
                                      " --records " + (folder / "here.sqlite").string());
  EXPECT_EQ(again.exit_code, 0) << "the trainee of the same records: " << again.err;
}

}  // namespace
}  // namespace arthro
