// Records of attempts: the same behaviour on SQLite and on PostgreSQL.
#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "app/records/attempts/outbox.h"
#include "app/records/attempts/progress.h"
#include "app/records/attempts/records_file.h"
#include "app/records/attempts/standings.h"
#include "app/records/people/audit.h"
#include "app/records/people/reference_groups.h"
#include "app/records/store/schema.h"
#include "app/records/store/table.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/postgres_server.h"
#include "tests/support/sample_attempts.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using test::Attempt;
using test::NewTrainee;
using test::RepeatedOptions;
using test::SampleExercise;
using test::SampleResult;
using test::TempFolder;

// Place of records, fresh for each check.
struct Place {
  std::string connection;
  fs::path folder;
  Records Open(std::uint64_t seed = 1) const {
    RecordsOptions options = RepeatedOptions(seed);
    options.folder = folder;
    return Records(connection, options);
  }
};

SessionRow SessionOf(Records& records, const std::string& code) {
  return StartSession(records, code, "arthroscene 0.1.0", "mouse");
}

std::int64_t CountOf(Records& records, const std::string& table) {
  return WholeOf(records.database().Ask("SELECT CAST(count(*) AS BIGINT) FROM " + table)[0][0]);
}

void AttemptIsReadAsItWasWritten(const Place& place) {
  Records records = place.Open();
  AddTrainee(records, NewTrainee("T-1", "2026"));
  const SessionRow session = SessionOf(records, "T-1");
  const AttemptRecord written = Attempt(records, session, SampleExercise());
  const auto read = ReadAttempt(records, written.id);
  ASSERT_TRUE(read);
  RecordsBundle a, b;
  a.attempts = {written};
  b.attempts = {*read};
  // Metrics are read in the order of their names.
  std::swap(a.attempts[0].metrics[0], a.attempts[0].metrics[1]);
  EXPECT_EQ(RecordsText(a), RecordsText(b));
  const MetricRow& missing = read->metrics.back();
  EXPECT_EQ(missing.name, "tool_loss");
  EXPECT_FALSE(missing.value);
  EXPECT_NE(missing.why_none, "");
  EXPECT_FALSE(FinishAttempt(records, written)) << "it was recorded twice";
  EXPECT_EQ(CountOf(records, "events"), 4);
}

void NanIsNothing(const Place& place) {
  Records records = place.Open();
  AddTrainee(records, NewTrainee("T-1"));
  auto running = StartAttempt(records, SessionOf(records, "T-1"), SampleExercise(), "Demo",
                              AttemptMode::kTest, 1);
  SetResult(running.record, SampleResult());
  running.record.metrics[0].value = std::nan("");
  FinishAttempt(records, running.record);
  EXPECT_EQ(CountOf(records, "metrics WHERE value IS NULL"), 2);
}

void RunningAttemptWhoseProgramIsGoneIsStopped(const Place& place) {
  Records records = place.Open();
  AddTrainee(records, NewTrainee("T-1"));
  const SessionRow session = SessionOf(records, "T-1");
  const auto alive =
      StartAttempt(records, session, SampleExercise(), "Demo", AttemptMode::kTest, 1);
  std::string dead, unreadable;
  for (std::string* id : {&dead, &unreadable})
    *id = StartAttempt(records, session, SampleExercise(), "Demo", AttemptMode::kTest, 1).record.id;
  EXPECT_TRUE(RecoverAttempts(records, {}).empty()) << "these are of another folder";
  // A program that is killed leaves its mark without a lock.
  for (const std::string& id : {dead, unreadable})
    WriteAtomically(place.folder / MarkNameOf(id), "");
  const auto said = RecoverAttempts(records, [&](const AttemptRecord& record) {
    return record.id == dead ? std::optional(SampleResult(31)) : std::nullopt;
  });
  EXPECT_EQ(said.size(), 2u);
  EXPECT_EQ(ReadAttempt(records, alive.record.id)->outcome, AttemptOutcome::kRunning);
  const auto assessed = ReadAttempt(records, dead);
  EXPECT_EQ(assessed->outcome, AttemptOutcome::kStopped);
  EXPECT_EQ(assessed->duration, 31);
  EXPECT_EQ(assessed->metrics.size(), 3u);
  EXPECT_EQ(ReadAttempt(records, unreadable)->outcome, AttemptOutcome::kStopped);
  EXPECT_FALSE(ReadAttempt(records, unreadable)->duration);
  EXPECT_TRUE(RecoverAttempts(records, {}).empty());
}

void CodesAreUnique(const Place& place) {
  Records records = place.Open();
  AddTrainee(records, NewTrainee("T-1"));
  for (const char* code : {"T-1", "", "Ada Lovelace", "T;1"})
    EXPECT_THROW(AddTrainee(records, NewTrainee(code)), Error) << code;
  EXPECT_THROW(SessionOf(records, "T-2"), Error);
  RenameTrainee(records, "T-1", "T-2", "anna");
  EXPECT_EQ(FindTrainee(records, "T-2").experience, 3);
  EXPECT_NE(FreeCode(records), FreeCode(records));
}

void ClockThatGoesBackKeepsTheOrder(const Place& place) {
  RecordsOptions options = RepeatedOptions();
  options.folder = place.folder;
  std::string now = "2026-11-23T23:59:59.999Z";
  options.now = [&] { return now; };
  Records records(place.connection, options);
  AddTrainee(records, NewTrainee("T-1"));
  const SessionRow session = SessionOf(records, "T-1");
  Attempt(records, session, SampleExercise(), 70);
  now = "2026-11-23T11:00:00.000Z";
  Attempt(records, session, SampleExercise(), 60);
  const auto attempts = AttemptsOf(records, "T-1");
  ASSERT_EQ(attempts.size(), 2u);
  EXPECT_EQ(attempts[0].duration, 70);
  EXPECT_EQ(attempts[1].started, "2026-11-24T00:00:00.000Z");
  ASSERT_EQ(AuditOf(records).size(), 1u);
}

void StandingsCountTriesAndGates(const Place& place) {
  Records records = place.Open();
  AddTrainee(records, NewTrainee("T-1", "A"));
  AddTrainee(records, NewTrainee("T-2", "B"));
  const SessionRow session = SessionOf(records, "T-1");
  const ExerciseRow first = SampleExercise(0), second = SampleExercise(1);
  Attempt(records, session, first, 80, true);
  Attempt(records, session, first, 70, true);
  Attempt(records, session, first, 60, false);
  Attempt(records, session, first, 50, true, AttemptMode::kRobot);
  Attempt(records, session, second, 40, true, AttemptMode::kPractice);
  Attempt(records, SessionOf(records, "T-2"), first, 90, false);
  OpenGate(records, "T-1", second.hash, "anna", "did it in the laboratory");
  EXPECT_THROW(OpenGate(records, "T-1", second.hash, "anna", ""), Error);
  const auto own = StandingsOf(records, "T-1");
  ASSERT_EQ(own.size(), 2u);
  EXPECT_EQ(own[0].tries, 3);
  EXPECT_EQ(own[0].passes, 2);
  EXPECT_EQ(own[0].best_time, 70);
  EXPECT_EQ(own[0].last_outcome, "failed");
  EXPECT_EQ(own[0].test_outcomes, "PPF");
  EXPECT_FALSE(own[0].is_gate_opened);
  EXPECT_EQ(own[1].test_outcomes, "");
  EXPECT_TRUE(own[1].is_gate_opened);
  EXPECT_EQ(CohortStandings(records).size(), 3u);
  const std::string code = "T-1";
  const auto robots = StandingsOf(records, std::span(&code, 1), Performers::kRobots);
  ASSERT_EQ(robots.size(), 1u);
  EXPECT_EQ(robots[0].tries, 1);
  EXPECT_EQ(robots[0].best_time, 50);
  EXPECT_EQ(robots[0].test_outcomes, "") << "a robot opens no gate";
  EXPECT_EQ(ProgressOf(records, code, first.hash, "task_time", "both", Performers::kRobots).size(),
            1u);
  const auto cohort = CohortStandings(records, "B");
  ASSERT_EQ(cohort.size(), 1u);
  EXPECT_EQ(cohort[0].trainee, "T-2");
  EXPECT_FALSE(cohort[0].best_time);
  ASSERT_EQ(AuditOf(records).size(), 1u);
  EXPECT_EQ(AuditOf(records)[0].who, "anna");
}

void ErasedTraineeLeavesAHashOnly(const Place& place) {
  Records records = place.Open();
  const ExerciseRow exercise = SampleExercise();
  for (const char* code : {"E-1", "E-2", "E-3"}) {
    AddTrainee(records, NewTrainee(code));
    const AttemptRecord attempt =
        Attempt(records, SessionOf(records, code), exercise, 40 + 10 * (code[2] - '0'), true);
    fs::create_directories(place.folder / "attempts");
    WriteAtomically(place.folder / attempt.log, "log");
  }
  ReferenceRule rule;
  rule.trainees = {"E-1", "E-2", "E-3"};
  rule.rig = "mouse";
  const ReferenceGroup group = MakeReferenceGroup(records, "experts", exercise.hash, rule);
  const auto time = std::find_if(group.values.begin(), group.values.end(),
                                 [](const auto& value) { return value.metric == "task_time"; });
  ASSERT_NE(time, group.values.end());
  EXPECT_EQ(time->n, 3);
  EXPECT_DOUBLE_EQ(*time->mean, 60);
  EXPECT_DOUBLE_EQ(*time->sd, 10);
  EXPECT_DOUBLE_EQ(*time->q1, 55);
  OpenGate(records, "E-3", exercise.hash, "anna", "a reason");
  const Erased erased = EraseTrainee(records, "E-3", "admin");
  EXPECT_EQ(erased.attempts, 1);
  EXPECT_EQ(erased.files, 1);
  EXPECT_EQ(erased.groups, std::vector<std::string>{"experts"});
  const auto groups = ReferenceGroupsOf(records);
  ASSERT_EQ(groups.size(), 1u);
  for (const auto& value : groups[0].values)
    if (value.metric == "task_time") {
      EXPECT_EQ(value.n, 2);
      EXPECT_DOUBLE_EQ(*value.mean, 55);
    }
  EXPECT_EQ(groups[0].rule.find("E-3"), std::string::npos);
  for (const AuditRow& row : AuditOf(records)) EXPECT_TRUE(row.subject.starts_with("erased-"));
  EXPECT_EQ(RecordsText(ReadBundle(records)).find("E-3"), std::string::npos);
  EXPECT_THROW(EraseTrainee(records, "E-3", "admin"), Error);
}

void OutboxIsMovedOnce(const Place& place) {
  Random random(7);
  std::vector<RecordsBundle> kept;
  for (int i = 0; i < 3; ++i) {
    RecordsBundle bundle = StartInOutbox(random, "T-9", {}, SampleExercise(),
                                         "2026-11-23T09:00:00.000Z", AttemptMode::kTest);
    bundle.attempts[0].started = fmt::format("2026-11-23T09:0{}:00.000Z", i);
    SetResult(bundle.attempts[0], SampleResult(50 + i, true));
    EXPECT_NE(FinishOrKeep(nullptr, place.folder, bundle), "");
    kept.push_back(bundle);
  }
  struct stat status {};
  ASSERT_EQ(::stat((OutboxOf(place.folder) / (kept[0].attempts[0].id + ".json")).c_str(), &status),
            0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  WriteAtomically(OutboxOf(place.folder) / "damaged.json", "{");
  Records records = place.Open();
  const Synced synced = SyncOutbox(records, place.folder);
  EXPECT_EQ(synced.fresh, 3);
  EXPECT_EQ(synced.refused.size(), 1u);
  EXPECT_EQ(AttemptsOf(records, "T-9").size(), 3u);
  EXPECT_EQ(TraineesOf(records).size(), 1u) << "one code is one trainee";
  KeepInOutbox(place.folder, kept[1]);
  EXPECT_EQ(SyncOutbox(records, place.folder).known, 1);
  EXPECT_EQ(CountOf(records, "attempts"), 3);
  EXPECT_EQ(CountOf(records, "steps"), 6);
}

void FormsAreKeptWithTheirAttempt(const Place& place) {
  Records records = place.Open();
  AddTrainee(records, NewTrainee("T-1"));
  const AttemptRecord attempt = Attempt(records, SessionOf(records, "T-1"), SampleExercise());
  RecordsBundle bundle = ReadBundleOf(records, attempt.id);
  FormRow form;
  form.id = records.NewId();
  form.attempt = attempt.id;
  form.form = "asset";
  form.rater = "R-1";
  form.made = records.Now();
  form.items = {{"safety", 3}, {"other", -1}};
  bundle.forms = {form};
  PutAttempt(records, bundle, bundle.attempts[0]);
  const RecordsBundle read = ReadBundle(records, "T-1");
  ASSERT_EQ(read.forms.size(), 1u);
  ASSERT_EQ(read.forms[0].items.size(), 2u);
  EXPECT_EQ(read.forms[0].items[0].item, "other");
  EXPECT_EQ(read.forms[0].items[0].score, -1);
  EXPECT_EQ(read.forms[0].items[1].score, 3);
}

using Check = void (*)(const Place&);
constexpr std::pair<const char*, Check> kChecks[] = {
    {"an attempt", AttemptIsReadAsItWasWritten},
    {"NaN", NanIsNothing},
    {"a running attempt", RunningAttemptWhoseProgramIsGoneIsStopped},
    {"codes", CodesAreUnique},
    {"the clock", ClockThatGoesBackKeepsTheOrder},
    {"standings", StandingsCountTriesAndGates},
    {"erase", ErasedTraineeLeavesAHashOnly},
    {"the outbox", OutboxIsMovedOnce},
    {"forms", FormsAreKeptWithTheirAttempt},
};

TEST(Records, KeepAttemptsInSqlite) {
  for (const auto& [name, check] : kChecks) {
    SCOPED_TRACE(name);
    TempFolder folder;
    check({(folder / "r.sqlite").string(), folder.path()});
  }
}

TEST(Records, KeepAttemptsInPostgresqlLikewise) {
  test::PostgresServer server;
  if (!server.why_none().empty()) GTEST_SKIP() << server.why_none();
  for (const auto& [name, check] : kChecks) {
    SCOPED_TRACE(name);
    TempFolder folder;
    {
      Database database(server.connection(), 10);
      database.Do("DROP SCHEMA public CASCADE");
      database.Do("CREATE SCHEMA public");
    }
    check({server.connection(), folder.path()});
  }
}

TEST(Records, AreForTheirOwnerAlone) {
  TempFolder folder;
  const fs::path file = folder / "new/with space \"quoted\"/r.sqlite";
  Records records(file.string(), RepeatedOptions());
  AddTrainee(records, NewTrainee("T-1"));
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(Records, RepeatWithTheSameSeed) {
  std::string texts[2];
  for (std::string& text : texts) {
    TempFolder folder;
    Records records((folder / "r.sqlite").string(), RepeatedOptions(5));
    AddTrainee(records, NewTrainee("T-1"));
    Attempt(records, SessionOf(records, "T-1"), SampleExercise());
    text = RecordsText(ReadBundle(records));
  }
  EXPECT_EQ(texts[0], texts[1]);
}

TEST(Migrate, CopiesBeforeItChangesAndRefusesNewerRecords) {
  TempFolder folder;
  const std::string file = (folder / "r.sqlite").string();
  {
    Records records(file, RepeatedOptions());
    AddTrainee(records, NewTrainee("T-1"));
    EXPECT_EQ(SchemaOf(records.database()), 1);
    EXPECT_TRUE(records.copy().empty());
  }
  std::vector<Migration> two(EveryMigration().begin(), EveryMigration().end());
  two.push_back({2, {"ALTER TABLE trainees ADD COLUMN note TEXT"}});
  std::vector<Migration> broken = two;
  broken[1].statements.push_back("ALTER TABLE nowhere ADD COLUMN note TEXT");
  Database database(file, 10);
  EXPECT_THROW(Migrate(database, broken), Error);
  EXPECT_EQ(SchemaOf(database), 1) << "a migration that fails changes nothing";
  const fs::path copy = Migrate(database, two);
  EXPECT_EQ(SchemaOf(database), 2);
  Database before(copy.string(), 10);
  EXPECT_EQ(SchemaOf(before), 1);
  EXPECT_EQ(before.Ask("SELECT code FROM trainees").size(), 1u);
  try {
    Records newer(file, RepeatedOptions());
    FAIL() << "records of a newer schema were opened";
  } catch (const Error& fault) {
    EXPECT_NE(std::string(fault.what()).find("update the program"), std::string::npos);
  }
}

TEST(Records, StartPageReadsTheIndexAlone) {
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  std::string plan;
  for (const Row& row : records.database().Ask(
           "EXPLAIN QUERY PLAN SELECT trainee, exercise, count(*), max(started), min(CASE outcome "
           "WHEN 'passed' THEN duration END) FROM attempts WHERE mode <> 'robot' AND outcome <> "
           "'running' GROUP BY trainee, exercise"))
    plan += TextOf(row[3]) + "\n";
  EXPECT_NE(plan.find("USING COVERING INDEX attempts_of_trainees"), std::string::npos) << plan;
  EXPECT_EQ(plan.find("TEMP B-TREE"), std::string::npos) << plan;
}

}  // namespace
}  // namespace arthro::app
