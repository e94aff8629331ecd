// Exports of the records: tables, statements of the Experience API, studies, backups, and forms.
#include <regex>
#include <set>
#include <sys/stat.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/records/attempts/records_file.h"
#include "app/records/exchange/attempt_table.h"
#include "app/records/exchange/backup.h"
#include "app/records/exchange/rating_form.h"
#include "app/records/exchange/study.h"
#include "app/records/exchange/xapi.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/schema_fault.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

using namespace test;
namespace fs = std::filesystem;

// Two trainees; T-1 has a rated attempt and one by a robot.
RecordsBundle Sample() {
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  AddTrainee(records, NewTrainee("T-1", "Residents of Unit 7"));
  AddTrainee(records, NewTrainee("T-2"));
  const SessionRow session = StartSession(records, "T-1", "arthroscene 0.1.0", "mouse");
  const AttemptRecord rated = Attempt(records, session, SampleExercise(0), 74, false);
  Attempt(records, session, SampleExercise(1), 61.5, true);
  Attempt(records, session, SampleExercise(1), 20, true, AttemptMode::kRobot);
  Attempt(records, StartSession(records, "T-2", "arthroscene 0.1.0", "touch"), SampleExercise(1),
          90, true, AttemptMode::kPractice);
  RecordsBundle bundle = ReadBundle(records);
  FormRow form;
  form.id = records.NewId();
  form.attempt = rated.id;
  form.form = "asset";
  form.rater = "Dr Anna";
  form.made = records.Now();
  form.comment = "T-1 was nervous, see Tuesday";
  form.items = {{"safety", 4}};
  bundle.forms = {form};
  return bundle;
}

TEST(AttemptTable, HasOneRowPerAttemptAndEmptyCellsForMissingValues) {
  const std::string table = AttemptTable(Sample());
  EXPECT_TRUE(table.starts_with(kAttemptTableHead));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  EXPECT_NE(table.find(",peak_force instrument [N],task_time both [s],tool_loss instrument\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find(",9.1,74,\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("nan"), std::string::npos);
  const std::string forms = FormTable(Sample());
  EXPECT_NE(forms.find(",safety,4,\"T-1 was nervous, see Tuesday\"\n"), std::string::npos) << forms;
}

// Rules of xAPI 1.0.3, part 2: ids, actors with one identifier, verbs and extensions are IRIs,
// durations of ISO 8601, and no score.
TEST(Xapi, StatementsFollowTheRulesAndHaveNoScore) {
  const XapiStatements statements = XapiOf(Sample(), "https://lab.example/");
  EXPECT_EQ(statements.left_out, 1) << "the robot";
  const auto list = nlohmann::json::parse(statements.text);
  ASSERT_EQ(list.size(), 3u);
  const std::regex uuid("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"),
      iri("https?://[^ \"<>{}|\\\\^`]+"), duration("PT[0-9]+(\\.[0-9]{1,2})?S"),
      time("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}\\.[0-9]{3}Z");
  const std::set<std::string> allowed = {"id",     "actor",   "verb",     "object",
                                         "result", "context", "timestamp"};
  std::set<std::string> ids, verbs;
  for (const auto& own : list) {
    for (const auto& [key, value] : own.items()) EXPECT_TRUE(allowed.contains(key)) << key;
    EXPECT_TRUE(std::regex_match(own["id"].get<std::string>(), uuid));
    EXPECT_TRUE(ids.insert(own["id"]).second);
    EXPECT_EQ(own["actor"]["objectType"], "Agent");
    EXPECT_EQ(own["actor"].size(), 2u) << "exactly one identifier";
    EXPECT_EQ(own["actor"]["account"].size(), 2u);
    EXPECT_TRUE(std::regex_match(own["actor"]["account"]["homePage"].get<std::string>(), iri));
    const std::string verb = own["verb"]["id"];
    EXPECT_TRUE(std::regex_match(verb, std::regex("http://adlnet\\.gov/expapi/verbs/(passed|failed|"
                                                  "completed)")))
        << verb;
    verbs.insert(verb);
    const std::string activity = own["object"]["id"];
    EXPECT_TRUE(std::regex_match(activity, iri));
    EXPECT_TRUE(std::regex_search(activity, std::regex("/versions/1$"))) << activity;
    EXPECT_TRUE(std::regex_match(own["timestamp"].get<std::string>(), time));
    const auto& result = own["result"];
    EXPECT_FALSE(result.contains("score"));
    EXPECT_TRUE(result["completion"].is_boolean());
    EXPECT_EQ(result["success"], verb.ends_with("passed"));
    EXPECT_TRUE(std::regex_match(result["duration"].get<std::string>(), duration));
    for (const auto* extensions : {&result["extensions"], &own["context"]["extensions"]})
      for (const auto& [key, value] : extensions->items())
        EXPECT_TRUE(std::regex_match(key, iri)) << key;
  }
  EXPECT_EQ(verbs.size(), 2u);
  for (const char* home : {"", "lab", "ftp://lab", "https://", "https://a b"})
    EXPECT_THROW(XapiOf(Sample(), home), Error) << home;
}

TEST(Study, TellsNothingOfTheDepartment) {
  const RecordsBundle before = Sample(), after = ForStudy(before, 11);
  const std::string text = RecordsText(after) + AttemptTable(after) + FormTable(after);
  for (const char* word : {"T-1", "T-2", "Unit 7", "Anna", "nervous", "station-1", "2026-11"})
    EXPECT_EQ(text.find(word), std::string::npos) << word;
  for (const AttemptRecord& attempt : before.attempts)
    EXPECT_EQ(text.find(attempt.id), std::string::npos);
  ASSERT_EQ(after.attempts.size(), before.attempts.size());
  EXPECT_EQ(SchemaFault("records-1", RecordsText(after)), "");
  EXPECT_EQ(RecordsText(ForStudy(before, 11)), RecordsText(after));
  EXPECT_NE(RecordsText(ForStudy(before, 12)), RecordsText(after));
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  EXPECT_EQ(Import(records, after).fresh, 4) << "the references hold";
}

TEST(Backup, IsWholePrivateAndNeverReplaces) {
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  Import(records, Sample());
  const fs::path copy = folder / "copy.sqlite";
  Backup(records, copy);
  struct stat status {};
  ASSERT_EQ(::stat(copy.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  RecordsOptions elsewhere = RepeatedOptions();
  elsewhere.folder = folder / "other";
  Records read(copy.string(), elsewhere);
  EXPECT_EQ(RecordsText(ReadBundle(read)), RecordsText(ReadBundle(records)));
  EXPECT_THROW(Backup(records, copy), Error);
  EXPECT_TRUE(CheckRecords(read).faults.empty());
  EXPECT_EQ(CheckRecords(read).attempts, 4);
}

TEST(CheckRecords, NamesAFileThatIsNotThere) {
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  AddTrainee(records, NewTrainee("T-1"));
  const SessionRow session = StartSession(records, "T-1", "arthroscene 0.1.0", "mouse");
  auto running = StartAttempt(records, session, SampleExercise(), "Demo", AttemptMode::kTest, 1);
  SetResult(running.record, SampleResult());
  running.record.log_bytes = 12;
  FinishAttempt(records, running.record);
  EXPECT_EQ(CheckRecords(records).faults.size(), 1u);
  WriteAtomically(folder / running.record.log, "twelve bytes");
  EXPECT_TRUE(CheckRecords(records).faults.empty());
}

TEST(RatingForm, ShippedFormsAreReadAndWrittenAlike) {
  const fs::path resources = fs::path(ARTHRO_SOURCE_DIR) / "resources";
  const auto forms = ReadForms(resources / "forms");
  ASSERT_EQ(forms.size(), 2u);
  EXPECT_EQ(forms[0].id, "asset");
  ASSERT_EQ(forms[0].items.size(), 8u);
  int largest = 0;
  for (const FormItem& item : forms[0].items) largest += item.most;
  EXPECT_EQ(largest, 38);
  for (const RatingForm& form : forms) {
    EXPECT_EQ(FormText(FormFromText(FormText(form))), FormText(form));
    EXPECT_EQ(SchemaFault("form-1", FormText(form)), "");
  }
  EXPECT_EQ(ReadWholeFile(resources / "schemas/form-1.schema.json"), FormSchema());
}

TEST(RatingForm, IsPassedWithThreeInEachItem) {
  RatingForm form;
  form.pass_each = 3;
  form.items = {{"a", "A", 1, 5, {}}, {"b", "B", 1, 5, {}}};
  FormRow filled;
  filled.items = {{"a", 5}};
  EXPECT_FALSE(IsPassed(form, filled)) << "an item is missing";
  filled.items.push_back({"b", 3});
  EXPECT_TRUE(IsPassed(form, filled));
  filled.items[1].score = 2;
  EXPECT_FALSE(IsPassed(form, filled));
  filled.items[1].score = 6;
  EXPECT_THROW(CheckRatings(form, filled), Error);
  filled.items[1] = {"c", 3};
  EXPECT_THROW(CheckRatings(form, filled), Error);
}

}  // namespace
}  // namespace arthro::app
