#include "app/records/attempts/records_file.h"

#include <map>

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
  for (AttemptRecord& attempt : bundle.attempts) by_id[attempt.id] = &attempt;
  const std::string where =
      attempts.empty() ? ""
                       : fmt::format("WHERE attempt IN (SELECT id FROM attempts {})", attempts);
  Attach(database, "steps", "seq", by_id, &AttemptRecord::steps, where, values);
  Attach(database, "metrics", "name, part", by_id, &AttemptRecord::metrics, where, values);
  Attach(database, "criteria", "seq", by_id, &AttemptRecord::criteria, where, values);
  Attach(database, "events", "seq", by_id, &AttemptRecord::events, where, values);
  // Rows that the attempts name by `key`, and no others.
  const auto named = [&](const char* key) {
    return fmt::format("(SELECT {} FROM attempts {})", key, attempts);
  };
  bundle.trainees = Select<TraineeRow>(
      database, "trainees", fmt::format("WHERE id IN {} ORDER BY code", named("trainee")), values);
  bundle.cohorts = Select<CohortRow>(
      database, "cohorts",
      fmt::format("WHERE id IN (SELECT cohort FROM trainees WHERE id IN {}) ORDER BY name",
                  named("trainee")),
      values);
  bundle.exercises = Select<ExerciseRow>(
      database, "exercises",
      fmt::format("WHERE hash IN {} ORDER BY id, version, hash", named("exercise")), values);
  bundle.sessions = Select<SessionRow>(
      database, "sessions", fmt::format("WHERE id IN {} ORDER BY started, id", named("session")),
      values);
  bundle.forms = Select<FormRow>(database, "forms", where + " ORDER BY made, id", values);
  std::map<std::string, FormRow*> forms;
  for (FormRow& form : bundle.forms) forms[form.id] = &form;
  const std::string of_forms =
      where.empty() ? "" : fmt::format("WHERE form IN (SELECT id FROM forms {})", where);
  for (const Row& row : database.Ask(
           fmt::format("SELECT item, score, form FROM form_items {} ORDER BY form, item", of_forms),
           values))
    if (const auto form = forms.find(TextOf(row[2])); form != forms.end())
      form->second->items.emplace_back().Visit(internal::RowReader{row});
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
