// Records under attack and under load: writers that are killed at random moments, and many writers
// at once. No attempt may be lost, doubled or half there.
//   hostile_records [--kills 20] [--attempts 400] [--seed 1]
// PostgreSQL takes part where it is installed; the program says so where it is not.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/records/attempts/attempts.h"
#include "app/records/attempts/outbox.h"
#include "app/records/exchange/backup.h"
#include "app/records/people/trainees.h"
#include "app/records/store/table.h"
#include "simulation/core/error.h"
#include "tests/support/postgres_server.h"
#include "tests/support/sample_attempts.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

using namespace app;
namespace fs = std::filesystem;

constexpr double kPatience = 300;  // s to wait for other writers on a busy machine

int failures = 0;

void Fail(const std::string& sentence) {
  ++failures;
  fmt::print("FAILED: {}\n", sentence);
}

double Now() {  // s
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RecordsOptions Station(const std::string& name, std::uint64_t seed, const fs::path& folder) {
  RecordsOptions options;
  options.station = name;
  options.seed = seed;
  options.timeout = kPatience;
  options.folder = folder;
  return options;
}

// Runs `work` in a child; it ends there, without the destructors of this process.
pid_t Fork(const std::function<void()>& work) {
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child != 0) return child;
  int status = 0;
  try {
    work();
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    status = 1;
  }
  ::_exit(status);
}

std::int64_t CountOf(Records& records, const std::string& what) {
  return WholeOf(records.database().Ask("SELECT CAST(count(*) AS BIGINT) FROM " + what)[0][0]);
}

// Every attempt that is over has all of its rows, and no other row is there.
void CheckWhole(Records& records, const std::string& words) {
  const std::int64_t whole = CountOf(records, "attempts WHERE outcome <> 'running'");
  const std::pair<const char*, int> kRows[] = {
      {"steps", 2}, {"metrics", 3}, {"criteria", 2}, {"events", 4}};
  for (const auto& [table, rows] : kRows)
    if (const auto found = CountOf(records, table); found != rows * whole)
      Fail(fmt::format("{}: {} attempts are over, and {} has {} rows", words, whole, table, found));
}

// ---- Killed writers. ----

void WriteForEver(const std::string& connection, const fs::path& folder, const fs::path& log,
                  std::uint64_t seed) {
  Records records(connection, Station("killed", seed, folder));
  const SessionRow session = StartSession(records, "T-1", "hostile", "none");
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const auto say = [&](const char* what, const std::string& id) {
    const std::string line = fmt::format("{} {}\n", what, id);
    if (::write(file, line.data(), line.size()) < 0) throw std::runtime_error("log");
  };
  for (;;) {
    auto running = StartAttempt(records, session, SampleExercise(), "Demo", AttemptMode::kTest, 1);
    say("began", running.record.id);
    SetResult(running.record, SampleResult());
    FinishAttempt(records, running.record);
    say("ended", running.record.id);
  }
}

void Kill(const std::string& connection, int count, unsigned seed, const char* words) {
  TempFolder folder;
  std::mt19937 random(seed);
  const fs::path log = folder / "log";
  {
    Records records(connection, Station("killed", 1, folder.path()));
    AddTrainee(records, NewTrainee("T-1"));
  }
  int recovered = 0;
  for (int i = 0; i < count; ++i) {
    const auto size = [&] {
      std::error_code ignored;
      const auto bytes = fs::file_size(log, ignored);
      return ignored ? std::uintmax_t{0} : bytes;
    };
    const auto before = size();
    const pid_t child = Fork([&] {
      WriteForEver(connection, folder.path(), log, 1000 + static_cast<std::uint64_t>(i));
    });
    const double deadline = Now() + kPatience;
    while (size() == before && Now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const int wait = std::uniform_int_distribution<int>(0, 60000)(random);
    std::this_thread::sleep_for(std::chrono::microseconds(wait));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    Records records(connection,
                    Station("killed", 500000 + static_cast<std::uint64_t>(i), folder.path()));
    recovered += static_cast<int>(
        RecoverAttempts(records, [](const AttemptRecord&) { return SampleResult(31); }).size());
    if (CountOf(records, "attempts WHERE outcome = 'running'") != 0)
      Fail(fmt::format("{}: kill {} left a running attempt", words, i));
    CheckWhole(records, fmt::format("{}: kill {}", words, i));
  }
  Records records(connection, Station("killed", 2, folder.path()));
  std::map<std::string, std::string> outcome;
  for (const AttemptRecord& attempt : AttemptsOf(records, "T-1"))
    if (!outcome.emplace(attempt.id, simulation::ToString(attempt.outcome)).second)
      Fail(fmt::format("{}: attempt {} is there twice", words, attempt.id));
  std::set<std::string> began, ended;
  std::ifstream lines(log);
  for (std::string what, id; lines >> what >> id;) (what == "began" ? began : ended).insert(id);
  for (const std::string& id : began)
    if (!outcome.contains(id)) Fail(fmt::format("{}: attempt {} is lost", words, id));
  for (const std::string& id : ended)
    if (outcome[id] != "failed")
      Fail(fmt::format("{}: attempt {} was over, and is {}", words, id, outcome[id]));
  // A child that is killed between its commit and its line has one attempt more.
  if (outcome.size() > began.size() + static_cast<std::size_t>(count))
    Fail(fmt::format("{}: {} attempts began, {} are there", words, began.size(), outcome.size()));
  for (const std::string& fault : CheckRecords(records).faults) Fail(fault);
  fmt::print("{}: {} kills, {} attempts, {} of them cut short and assessed from their logs\n",
             words, count, outcome.size(), recovered);
}

// ---- Many writers. ----

void Load(const std::string& connection, int processes, int attempts, const char* words) {
  TempFolder folder;
  {
    Records records(connection, Station("load", 1, folder.path()));
    for (int p = 0; p < processes; ++p) AddTrainee(records, NewTrainee(fmt::format("L-{}", p)));
  }
  const double start = Now();
  std::vector<pid_t> children;
  for (int p = 0; p < processes; ++p)
    children.push_back(Fork([&] {
      const std::string name = fmt::format("station-{}", p);
      Records records(connection,
                      Station(name, 1000 + static_cast<std::uint64_t>(p), folder.path() / name));
      const SessionRow session = StartSession(records, fmt::format("L-{}", p), "hostile", "none");
      for (int i = p; i < attempts; i += processes) {
        auto running =
            StartAttempt(records, session, SampleExercise(i % 14), "Demo", AttemptMode::kTest, 1);
        SetResult(running.record, SampleResult(40 + i % 60, i % 3 == 0));
        RecordsBundle bundle;
        bundle.attempts = {running.record};
        FinishOrKeep(&records, folder.path() / name, bundle);
      }
    }));
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    if (status != 0) Fail(fmt::format("{}: a writer ended with status {}", words, status));
  }
  const double seconds = Now() - start;
  Records records(connection, Station("load", 2, folder.path()));
  int kept = 0;
  for (int p = 0; p < processes; ++p)
    kept += SyncOutbox(records, folder.path() / fmt::format("station-{}", p)).known;
  std::set<std::string> ids;
  std::size_t rows = 0;
  for (int p = 0; p < processes; ++p)
    for (const AttemptRecord& attempt : AttemptsOf(records, fmt::format("L-{}", p))) {
      ids.insert(attempt.id);
      ++rows;
    }
  if (rows != static_cast<std::size_t>(attempts) || ids.size() != rows)
    Fail(fmt::format("{}: {} attempts were made, {} are there, {} of them different", words,
                     attempts, rows, ids.size()));
  CheckWhole(records, words);
  fmt::print("{}: {} writers, {} attempts in {:.1f} s, {:.0f} per second, {} by the outbox\n",
             words, processes, attempts, seconds, attempts / seconds, kept);
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  using namespace arthro::test;
  CLI::App program("Kills and loads records of attempts.");
  int kills = 20, attempts = 400;
  unsigned seed = 1;
  program.add_option("--kills", kills, "Writers that are killed, per database.");
  program.add_option("--attempts", attempts, "Attempts of all writers, per database.");
  program.add_option("--seed", seed, "Start of the random sequence.");
  CLI11_PARSE(program, argc, argv);
  const auto run = [&](const std::function<std::string()>& fresh, int writers, const char* words) {
    if (kills > 0) Kill(fresh(), kills, seed, words);
    if (attempts > 0) Load(fresh(), writers, attempts, words);
  };
  try {
    TempFolder folder;
    int files = 0;
    run([&] { return (folder / fmt::format("{}.sqlite", files++)).string(); }, 4, "SQLite");
    PostgresServer server;
    if (!server.why_none().empty()) {
      fmt::print("PostgreSQL is left out: {}\n", server.why_none());
    } else {
      run(
          [&] {
            arthro::app::Database database(server.connection(), 10);
            database.Do("DROP SCHEMA public CASCADE");
            database.Do("CREATE SCHEMA public");
            return server.connection();
          },
          20, "PostgreSQL");
    }
  } catch (const std::exception& fault) {
    fmt::print("FAILED: {}\n", fault.what());
    return 1;
  }
  fmt::print("{} failures\n", failures);
  return failures == 0 ? 0 : 1;
}
