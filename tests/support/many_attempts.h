// Records with many attempts, written in one transaction: attempts of each trainee go round the
// exercises, and every third one is passed.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/records/store/table.h"
#include "tests/support/sample_attempts.h"

namespace arthro::test {

struct RecordsSize {
  int trainees = 0, attempts = 0;  // attempts: of each trainee
};

inline std::string CodeOf(int trainee) { return fmt::format("P-{:04}", trainee); }

// Tries of a trainee at one of the exercises.
inline int Tries(const RecordsSize& size, int exercise, int exercises) {
  return (size.attempts + exercises - 1 - exercise) / exercises;
}

inline void FillRecords(app::Records& records, const RecordsSize& size,
                        const std::vector<app::ExerciseRow>& exercises) {
  using namespace app;
  std::vector<TraineeRow> people;
  std::vector<SessionRow> sessions;
  std::vector<AttemptRecord> attempts;
  for (int t = 0; t < size.trainees; ++t) {
    TraineeRow& trainee = people.emplace_back(NewTrainee(CodeOf(t)));
    trainee.id = records.NewId();
    trainee.created = records.Now();
    sessions.push_back(
        {records.NewId(), trainee.id, records.station(), trainee.created, {}, "", ""});
    for (int a = 0; a < size.attempts; ++a) {
      AttemptRecord& attempt = attempts.emplace_back();
      attempt.id = records.NewId();
      attempt.session = sessions.back().id;
      attempt.trainee = trainee.id;
      attempt.exercise = exercises[static_cast<std::size_t>(a) % exercises.size()].hash;
      attempt.started = UtcText(1'700'000'000'000 + 86'400'000LL * a + 1000LL * t);
      attempt.mode = AttemptMode::kTest;
      attempt.outcome = a % 3 == 0 ? AttemptOutcome::kPassed : AttemptOutcome::kFailed;
      attempt.duration = 40 + a;
      attempt.log = LogNameOf(attempt.id);
    }
  }
  Database& database = records.database();
  database.Write([&] {
    Insert(database, "trainees", people);
    Insert(database, "sessions", sessions);
    Insert(database, "exercises", exercises);
    Insert(database, "attempts", attempts);
    for (const AttemptRecord& attempt : attempts) {
      MetricRow time;
      time.name = "task_time";
      time.part = "both";
      time.value = attempt.duration;
      Insert(database, "metrics", std::vector{time}, {{"attempt", attempt.id}});
    }
  });
  if (database.kind() == DatabaseKind::kPostgresql) database.Do("ANALYZE");
}

}  // namespace arthro::test
