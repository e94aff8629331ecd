// Files of records: what is written is read again, and damaged files are refused in one sentence.
#include "app/records/attempts/records_file.h"

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/schema_fault.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

using namespace test;

RecordsBundle SampleFile() {
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  AddTrainee(records, NewTrainee("T-1", "2026"));
  const SessionRow session = StartSession(records, "T-1", "arthroscene 0.1.0", "mouse");
  Attempt(records, session, SampleExercise(0), 74, false);
  Attempt(records, session, SampleExercise(1), 61.5, true);
  return ReadBundle(records);
}

TEST(RecordsFile, IsReadAsItWasWritten) {
  const std::string text = RecordsText(SampleFile());
  EXPECT_EQ(RecordsText(RecordsFromText(text)), text);
  EXPECT_EQ(SchemaFault("records-1", text), "");
}

TEST(RecordsFile, SchemaIsUpToDate) {
  EXPECT_EQ(ReadWholeFile(std::filesystem::path(ARTHRO_SOURCE_DIR) /
                          "resources/schemas/records-1.schema.json"),
            RecordsSchema())
      << "run `arthroscene records check --schema > resources/schemas/records-1.schema.json`";
}

TEST(RecordsFile, ImportBringsEachAttemptOnce) {
  const RecordsBundle bundle = SampleFile();
  TempFolder folder;
  Records other((folder / "other.sqlite").string(), RepeatedOptions(9));
  AddTrainee(other, NewTrainee("T-1"));  // the same trainee under another id
  EXPECT_EQ(Import(other, bundle).fresh, 2);
  EXPECT_EQ(Import(other, bundle).known, 2);
  EXPECT_EQ(AttemptsOf(other, "T-1").size(), 2u);
  EXPECT_EQ(TraineesOf(other).size(), 1u);
}

TEST(RecordsFile, DamageIsRefusedInOneSentence) {
  const std::string text = RecordsText(SampleFile());
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    return other.replace(other.find(from), from.size(), to);
  };
  for (const std::string& damaged :
       {std::string("[]"), std::string("{"), changed("records/1", "records/2"),
        changed("\"test\"", "\"exam\""), changed("\"n\": 0", "\"n\": \"many\""),
        changed("\"hash\"", "\"hush\""), changed("\"duration\"", "\"total\"")}) {
    try {
      RecordsFromText(damaged, "r.json");
      ADD_FAILURE() << damaged.substr(0, 60);
    } catch (const Error& fault) {
      EXPECT_EQ(std::string(fault.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace arthro::app
