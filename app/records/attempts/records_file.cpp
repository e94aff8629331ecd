#include "app/records/attempts/records_file.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "app/records/attempts/attempts.h"
#include "app/records/store/table.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

// Rows of each table, grouped by the attempt to which they belong.
template <class T>
void Attach(Database& database, const std::string& table, const std::string& order,
            std::map<std::string, AttemptRecord*>& attempts, std::vector<T> AttemptRecord::*list,
            const std::string& where, const Row& values) {
  std::string columns = "attempt";
  for (const std::string& name : ColumnsOf<T>()) columns += ", " + name;
  for (Row row : database.Ask(
           fmt::format("SELECT {} FROM {} {} ORDER BY attempt, {}", columns, table, where, order),
           values)) {
    const auto found = attempts.find(TextOf(row[0]));
    if (found == attempts.end()) continue;
    row.erase(row.begin());
    (found->second->*list).emplace_back().Visit(internal::RowReader{row});
  }
}

// `attempts`: a condition on the table of attempts.
RecordsBundle ReadWhere(Records& records, const std::string& attempts, const Row& values) {
  Database& database = records.database();
  RecordsBundle bundle;
  bundle.attempts =
      Select<AttemptRecord>(database, "attempts", attempts + " ORDER BY started, id", values);
  std::map<std::string, AttemptRecord*> by_id;
  std::set<std::string> trainees, sessions, exercises, cohorts;
  for (AttemptRecord& attempt : bundle.attempts) {
    by_id[attempt.id] = &attempt;
    trainees.insert(attempt.trainee);
    sessions.insert(attempt.session);
    exercises.insert(attempt.exercise);
  }
  const std::string where =
      attempts.empty() ? ""
                       : fmt::format("WHERE attempt IN (SELECT id FROM attempts {})", attempts);
  Attach(database, "steps", "seq", by_id, &AttemptRecord::steps, where, values);
  Attach(database, "metrics", "name, part", by_id, &AttemptRecord::metrics, where, values);
  Attach(database, "criteria", "seq", by_id, &AttemptRecord::criteria, where, values);
  Attach(database, "events", "seq", by_id, &AttemptRecord::events, where, values);
  const auto keep = [](auto rows, const std::set<std::string>& keys, auto key) {
    std::erase_if(rows, [&](const auto& row) { return !keys.contains(row.*key); });
    return rows;
  };
  bundle.trainees =
      keep(Select<TraineeRow>(database, "trainees", "ORDER BY code"), trainees, &TraineeRow::id);
  for (const TraineeRow& trainee : bundle.trainees) cohorts.insert(trainee.cohort);
  bundle.cohorts =
      keep(Select<CohortRow>(database, "cohorts", "ORDER BY name"), cohorts, &CohortRow::id);
  bundle.exercises = keep(Select<ExerciseRow>(database, "exercises", "ORDER BY id, version, hash"),
                          exercises, &ExerciseRow::hash);
  bundle.sessions = keep(Select<SessionRow>(database, "sessions", "ORDER BY started, id"), sessions,
                         &SessionRow::id);
  bundle.forms = Select<FormRow>(database, "forms", where + " ORDER BY made, id", values);
  for (FormRow& form : bundle.forms)
    form.items =
        Select<FormItemRow>(database, "form_items", "WHERE form = :form ORDER BY item", {form.id});
  return bundle;
}

}  // namespace

RecordsBundle ReadBundle(Records& records, const std::string& trainee_code) {
  if (trainee_code.empty()) return ReadWhere(records, "", {});
  return ReadWhere(records, "WHERE trainee = (SELECT id FROM trainees WHERE code = :code)",
                   {trainee_code});
}

RecordsBundle ReadBundleOf(Records& records, const std::string& attempt) {
  RecordsBundle bundle = ReadWhere(records, "WHERE id = :id", {attempt});
  if (bundle.attempts.empty())
    throw Error(Code::kBadArgument,
                fmt::format("the records hold no attempt {}; `arthroscene records list` lists them",
                            attempt));
  return bundle;
}

Imported Import(Records& records, const RecordsBundle& bundle) {
  Imported imported;
  for (const AttemptRecord& attempt : bundle.attempts)
    ++(PutAttempt(records, bundle, attempt) ? imported.fresh : imported.known);
  return imported;
}

}  // namespace arthro::app
