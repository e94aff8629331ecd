#include "app/records/people/trainees.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

#include "app/records/people/audit.h"
#include "app/records/people/reference_groups.h"
#include "app/records/store/table.h"
#include "simulation/core/error.h"
#include "simulation/core/fingerprint.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestCode = 32;

void RefuseTaken(Records& records, const std::string& code) {
  if (KnowsTrainee(records, code))
    throw Error(Code::kBadArgument,
                fmt::format("the code {} belongs to another trainee; choose another, such as {}",
                            code, FreeCode(records)));
}

std::string CohortId(Records& records, const std::string& name) {
  if (name.empty()) return {};
  Database& database = records.database();
  Insert(database, "cohorts", std::vector{CohortRow{records.NewId(), name}});
  return TextOf(database.Ask("SELECT id FROM cohorts WHERE name = :name", {name}).at(0).at(0));
}

}  // namespace

void CheckTraineeCode(const std::string& code) {
  const bool is_plain = !code.empty() && code.size() <= kLongestCode &&
                        std::all_of(code.begin(), code.end(), [](unsigned char letter) {
                          return std::isalnum(letter) || letter == '-' || letter == '_';
                        });
  if (!is_plain)
    throw Error(Code::kBadArgument,
                fmt::format("the code of a trainee is \"{}\"; it may have 1 to {} letters of "
                            "A-Z, a-z, 0-9, - and _, and must not be a name",
                            code, kLongestCode));
}

TraineeRow AddTrainee(Records& records, TraineeRow trainee) {
  CheckTraineeCode(trainee.code);
  records.database().Write([&] {
    RefuseTaken(records, trainee.code);
    trainee.id = records.NewId();
    trainee.created = records.Now();
    trainee.cohort = CohortId(records, trainee.cohort);
    // Another station may have been faster.
    if (Insert(records.database(), "trainees", std::vector{trainee}) == 0)
      RefuseTaken(records, trainee.code);
  });
  return trainee;
}

std::string FreeCode(Records& records) {
  // Without letters that are read as others.
  constexpr std::string_view kLetters = "23456789ABCDEFGHJKMNPQRSTVWXYZ";
  for (;;) {
    Random random = RandomFromSystem();
    std::string code = "T-";
    for (int i = 0; i < 4; ++i) code += kLetters[random.Below(kLetters.size())];
    if (!KnowsTrainee(records, code)) return code;
  }
}

bool KnowsTrainee(Records& records, const std::string& code) {
  return !records.database().Ask("SELECT id FROM trainees WHERE code = :code", {code}).empty();
}

std::vector<TraineeRow> TraineesOf(Records& records) {
  return Select<TraineeRow>(records.database(), "trainees", "ORDER BY code");
}

std::vector<CohortRow> CohortsOf(Records& records) {
  return Select<CohortRow>(records.database(), "cohorts", "ORDER BY name");
}

TraineeRow FindTrainee(Records& records, const std::string& code) {
  const auto found =
      Select<TraineeRow>(records.database(), "trainees", "WHERE code = :code", {code});
  if (found.empty())
    throw Error(Code::kBadArgument,
                fmt::format("no trainee has the code {}; `arthroscene records trainee list` lists "
                            "all codes, and `add CODE` adds one",
                            code));
  return found[0];
}

void RenameTrainee(Records& records, const std::string& code, const std::string& new_code,
                   const std::string& who) {
  CheckTraineeCode(new_code);
  records.database().Write([&] {
    const TraineeRow trainee = FindTrainee(records, code);
    RefuseTaken(records, new_code);
    records.database().Do("UPDATE trainees SET code = :code WHERE id = :id",
                          {{new_code, trainee.id}});
    records.database().Do("UPDATE audit SET subject = :new_code WHERE subject = :code",
                          {{new_code, code}});
    WriteAudit(records, who, "new code", new_code);
  });
}

void OpenGate(Records& records, const std::string& trainee_code, const std::string& exercise_hash,
              const std::string& who, const std::string& reason) {
  if (who.empty() || reason.empty())
    throw Error(Code::kBadArgument,
                "a gate is opened by somebody and for a reason; give both, since they are kept");
  records.database().Write([&] {
    const TraineeRow trainee = FindTrainee(records, trainee_code);
    const auto exercise =
        Select<ExerciseRow>(records.database(), "exercises", "WHERE hash = :hash", {exercise_hash});
    if (exercise.empty())
      throw Error(
          Code::kBadArgument,
          fmt::format("the records hold no exercise {}; it is there after its first attempt",
                      exercise_hash));
    Insert(records.database(), "gates",
           std::vector{GateRow{trainee.id, exercise_hash, records.Now(), who}});
    WriteAudit(records, who,
               fmt::format("gate of {} version {} opened: {}", exercise[0].id, exercise[0].version,
                           reason),
               trainee_code);
  });
}

void OpenGate(Records& records, const std::string& trainee_code, const ExerciseRow& exercise,
              const std::string& who, const std::string& reason) {
  records.database().Write([&] { Insert(records.database(), "exercises", std::vector{exercise}); });
  OpenGate(records, trainee_code, exercise.hash, who, reason);
}

std::vector<GateRow> GatesOf(Records& records, const std::string& trainee_code) {
  return Select<GateRow>(records.database(), "gates",
                         "WHERE trainee = (SELECT id FROM trainees WHERE code = :code) "
                         "ORDER BY opened, exercise",
                         {trainee_code});
}

Erased EraseTrainee(Records& records, const std::string& code, const std::string& who) {
  Database& database = records.database();
  Erased erased;
  std::vector<fs::path> files;
  database.Write([&] {
    const TraineeRow trainee = FindTrainee(records, code);
    for (const Row& row : database.Ask(
             "SELECT attempts.log, sessions.station FROM attempts JOIN sessions ON sessions.id = "
             "attempts.session WHERE attempts.trainee = :id ORDER BY attempts.log",
             {trainee.id})) {
      const std::string log = TextOf(row[0]), station = TextOf(row[1]);
      if (log.empty()) continue;
      if (station == records.station())
        files.push_back(records.folder() / log);
      else
        erased.elsewhere.push_back(fmt::format("{}: {}", station, log));
    }
    const std::string attempts = "(SELECT id FROM attempts WHERE trainee = :id)";
    database.Do("DELETE FROM form_items WHERE form IN (SELECT id FROM forms WHERE attempt IN " +
                    attempts + ")",
                {{trainee.id}});
    erased.forms = database.Do("DELETE FROM forms WHERE attempt IN " + attempts, {{trainee.id}});
    for (const char* table : {"steps", "metrics", "criteria", "events"})
      database.Do(fmt::format("DELETE FROM {} WHERE attempt IN {}", table, attempts),
                  {{trainee.id}});
    erased.attempts = database.Do("DELETE FROM attempts WHERE trainee = :id", {{trainee.id}});
    for (const char* table : {"sessions", "gates"})
      database.Do(fmt::format("DELETE FROM {} WHERE trainee = :id", table), {{trainee.id}});
    database.Do("DELETE FROM trainees WHERE id = :id", {{trainee.id}});
    erased.groups = UpdateGroupsWithout(records, code);
    // The id is random and gone, so that the hash cannot be made again from a code.
    const std::string hash = "erased-" + FingerprintOf(trainee.id + code);
    database.Do("UPDATE audit SET subject = :hash WHERE subject = :code", {{hash, code}});
    WriteAudit(records, who, "trainee erased", hash);
  });
  for (const fs::path& file : files) {
    std::error_code ignored;
    erased.files += fs::remove(file, ignored);
  }
  return erased;
}

}  // namespace arthro::app
