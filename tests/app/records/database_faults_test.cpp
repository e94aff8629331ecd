// A database that cannot be used says so in one sentence, and the attempt is kept.
#include <chrono>
#include <csignal>
#include <future>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "app/records/attempts/outbox.h"
#include "app/records/attempts/records_file.h"
#include "app/records/store/table.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/postgres_server.h"
#include "tests/support/sample_attempts.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using namespace test;

std::string FaultOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& fault) {
    EXPECT_EQ(std::string(fault.what()).find('\n'), std::string::npos) << fault.what();
    return fault.what();
  }
  return "";
}

RecordsOptions Impatient() {
  RecordsOptions options = RepeatedOptions(3);
  options.timeout = 1;
  return options;
}

// A finished attempt of T-1 that is not in the records.
RecordsBundle Fresh(Random& random) {
  RecordsBundle bundle = StartInOutbox(random, "T-1", {}, SampleExercise(),
                                       "2026-11-23T09:00:00.000Z", AttemptMode::kTest);
  SetResult(bundle.attempts[0], SampleResult());
  return bundle;
}

TEST(DatabaseFault, LockedRecordsKeepTheAttemptInTheOutbox) {
  TempFolder folder;
  const std::string file = (folder / "r.sqlite").string();
  Records records(file, Impatient());
  Random random(1);
  {
    Database other(file, 1);
    other.Do("BEGIN EXCLUSIVE");
    EXPECT_NE(FaultOf([&] { AddTrainee(records, NewTrainee("T-1")); }).find("locked"),
              std::string::npos);
    EXPECT_NE(FinishOrKeep(&records, folder.path(), Fresh(random)).find("locked"),
              std::string::npos);
    other.Do("ROLLBACK");
  }
  EXPECT_EQ(SyncOutbox(records, folder.path()).fresh, 1);
  EXPECT_EQ(AttemptsOf(records, "T-1").size(), 1u);
}

TEST(DatabaseFault, RecordsThatCanOnlyBeReadAreReadAndNotWritten) {
  TempFolder folder;
  const std::string file = (folder / "r.sqlite").string();
  {
    Records records(file, RepeatedOptions());
    AddTrainee(records, NewTrainee("T-1"));
  }
  // Root may write everything, so the file of root is opened by a child with another user.
  ASSERT_EQ(::chmod(folder.path().c_str(), 0555), 0);
  ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(3);
    try {
      Records records(file, Impatient());
      if (TraineesOf(records).size() != 1) ::_exit(4);
      const std::string said = FaultOf([&] { AddTrainee(records, NewTrainee("T-2")); });
      ::_exit(said.find("can only be read") != std::string::npos ? 0 : 5);
    } catch (const std::exception& fault) {
      std::fprintf(stderr, "%s\n", fault.what());
      ::_exit(6);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  ::chmod(folder.path().c_str(), 0755);
}

TEST(DatabaseFault, AForeignOrDamagedFileIsRefused) {
  TempFolder folder;
  const fs::path file = folder / "r.sqlite";
  WriteAtomically(file, std::string(5000, 'x'));
  EXPECT_NE(FaultOf([&] { Records(file.string(), Impatient()); }).find("no database of records"),
            std::string::npos);
  EXPECT_EQ(ReadWholeFile(file), std::string(5000, 'x'));
  EXPECT_NE(FaultOf([&] { Records("mysql://host/name", Impatient()); }).find("postgresql://"),
            std::string::npos);
  EXPECT_NE(FaultOf([&] { Records("", Impatient()); }), "");
  EXPECT_NE(FaultOf([&] { Records("/proc/no/r.sqlite", Impatient()); }), "");
}

// A limit of the file's size has the effect of a full disk: writes come short.
TEST(DatabaseFault, AFullDiskLeavesTheRecordsWhole) {
  TempFolder folder;
  const std::string file = (folder / "r.sqlite").string();
  {
    Records records(file, RepeatedOptions());
    AddTrainee(records, NewTrainee("T-1"));
  }
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const auto size = static_cast<rlim_t>(fs::file_size(file));
    const rlimit limit{size, size};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      Records records(file, Impatient());
      Random random(1);
      std::string said;
      for (int i = 0; i < 300 && said.empty(); ++i)
        said = FinishOrKeep(&records, folder.path(), Fresh(random));
      ::_exit(said.find("make room") != std::string::npos &&
                      said.find("kept in") != std::string::npos
                  ? 0
                  : 5);
    } catch (const std::exception& fault) {
      std::fprintf(stderr, "%s\n", fault.what());
      ::_exit(6);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  Records records(file, RepeatedOptions(8));
  EXPECT_EQ(TextOf(records.database().Ask("PRAGMA integrity_check")[0][0]), "ok");
  const auto before = AttemptsOf(records, "T-1").size();
  EXPECT_EQ(SyncOutbox(records, folder.path()).fresh, 1);
  EXPECT_EQ(AttemptsOf(records, "T-1").size(), before + 1);
}

TEST(DatabaseFault, AServerThatGoesAwayKeepsTheAttemptInTheOutbox) {
  PostgresServer server;
  if (!server.why_none().empty()) GTEST_SKIP() << server.why_none();
  TempFolder folder;
  RecordsOptions options = Impatient();
  options.folder = folder.path();
  Records records(server.connection(), options);
  const TraineeRow trainee = AddTrainee(records, NewTrainee("T-1"));
  const SessionRow session = StartSession(records, "T-1", "arthroscene 0.1.0", "mouse");
  auto running = StartAttempt(records, session, SampleExercise(), "Demo", AttemptMode::kTest, 1);
  SetResult(running.record, SampleResult());
  server.Stop();
  RecordsBundle bundle;
  bundle.trainees = {trainee};
  bundle.sessions = {session};
  bundle.exercises = {SampleExercise()};
  bundle.attempts = {running.record};
  const std::string said = FinishOrKeep(&records, folder.path(), bundle);
  EXPECT_NE(said.find("does not answer"), std::string::npos) << said;
  EXPECT_NE(FaultOf([&] { Records(server.connection(), options); }).find("does not answer"),
            std::string::npos);
  ASSERT_TRUE(server.Start());
  Records again(server.connection(), options);
  EXPECT_EQ(SyncOutbox(again, folder.path()).fresh, 1);
  const auto attempts = AttemptsOf(again, "T-1");
  ASSERT_EQ(attempts.size(), 1u);
  EXPECT_EQ(attempts[0].outcome, AttemptOutcome::kFailed);
}

TEST(DatabaseFault, ACodeThatTwoStationsAddAtOnceIsRefusedForTheSecond) {
  PostgresServer server;
  if (!server.why_none().empty()) GTEST_SKIP() << server.why_none();
  TempFolder folder;
  RecordsOptions options = RepeatedOptions(3), other_options = RepeatedOptions(4);
  options.folder = other_options.folder = folder.path();
  Records records(server.connection(), options), other(server.connection(), other_options);
  std::future<std::string> second;
  records.database().Write([&] {
    TraineeRow trainee = NewTrainee("T-1");
    trainee.id = records.NewId();
    trainee.created = records.Now();
    Insert(records.database(), "trainees", std::vector{trainee});
    // It does not see the code yet, and waits for this transaction at its own row.
    second = std::async(std::launch::async,
                        [&] { return FaultOf([&] { AddTrainee(other, NewTrainee("T-1")); }); });
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  });
  EXPECT_NE(second.get().find("belongs to another trainee"), std::string::npos);
  EXPECT_EQ(TraineesOf(records).size(), 1u);
}

// An outbox may hold an attempt that the records never take.
TEST(DatabaseFault, AnAttemptThatIsRefusedDoesNotHoldUpTheOthers) {
  TempFolder folder;
  Records records((folder / "r.sqlite").string(), RepeatedOptions());
  Random random(1);
  for (int i = 0; i < 3; ++i) {
    RecordsBundle bundle = Fresh(random);
    if (i == 1) bundle.sessions.clear();  // it names a session that is nowhere
    KeepInOutbox(folder.path(), bundle);
  }
  const Synced synced = SyncOutbox(records, folder.path());
  EXPECT_EQ(synced.fresh, 2);
  EXPECT_EQ(synced.refused.size(), 1u);
  EXPECT_EQ(SyncOutbox(records, folder.path()).refused.size(), 1u) << "it stays";
}

TEST(DatabaseFault, APasswordIsNeverShown) {
  const std::string said =
      FaultOf([&] { Records("postgresql://anna:secret@127.0.0.1:1/none", Impatient()); });
  EXPECT_NE(said, "");
  EXPECT_EQ(said.find("secret"), std::string::npos) << said;
}

}  // namespace
}  // namespace arthro::app
