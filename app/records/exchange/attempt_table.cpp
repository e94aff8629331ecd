#include "app/records/exchange/attempt_table.h"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/csv_field.h"

namespace arthro::app {
namespace {

template <class T>
std::map<std::string, const T*> ById(const std::vector<T>& rows, std::string T::*key) {
  std::map<std::string, const T*> found;
  for (const T& row : rows) found[row.*key] = &row;
  return found;
}

std::string NumberText(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace

std::string AttemptTable(const RecordsBundle& bundle) {
  const auto trainees = ById(bundle.trainees, &TraineeRow::id);
  const auto cohorts = ById(bundle.cohorts, &CohortRow::id);
  const auto exercises = ById(bundle.exercises, &ExerciseRow::hash);
  const auto sessions = ById(bundle.sessions, &SessionRow::id);
  std::map<std::pair<std::string, std::string>, std::string> columns;  // metric, part -> unit
  for (const AttemptRecord& attempt : bundle.attempts)
    for (const MetricRow& metric : attempt.metrics)
      columns[{metric.name, metric.part}] = metric.unit;
  std::string text = fmt::format(
      "{}hand,experience,exercise,version,mode,started,station,rig,duration [s],outcome,reason,"
      "metrics_version",
      kAttemptTableHead);
  for (const auto& [key, unit] : columns)
    text += "," + CsvField(fmt::format("{} {}{}", key.first, key.second,
                                       unit.empty() ? "" : fmt::format(" [{}]", unit)));
  text += "\n";
  for (const AttemptRecord& attempt : bundle.attempts) {
    const TraineeRow trainee =
        trainees.contains(attempt.trainee) ? *trainees.at(attempt.trainee) : TraineeRow{};
    const ExerciseRow exercise =
        exercises.contains(attempt.exercise) ? *exercises.at(attempt.exercise) : ExerciseRow{};
    const SessionRow session =
        sessions.contains(attempt.session) ? *sessions.at(attempt.session) : SessionRow{};
    const std::string cohort =
        cohorts.contains(trainee.cohort) ? cohorts.at(trainee.cohort)->name : "";
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", attempt.id,
                        CsvField(trainee.code), CsvField(cohort), CsvField(trainee.hand),
                        trainee.experience < 0 ? "" : std::to_string(trainee.experience),
                        CsvField(exercise.id), exercise.version, ToString(attempt.mode),
                        attempt.started, CsvField(session.station), CsvField(session.rig),
                        NumberText(attempt.duration), simulation::ToString(attempt.outcome),
                        CsvField(attempt.reason), attempt.metrics_version);
    std::map<std::pair<std::string, std::string>, std::string> values;
    for (const MetricRow& metric : attempt.metrics)
      values[{metric.name, metric.part}] = NumberText(metric.value);
    for (const auto& [key, unit] : columns) text += "," + values[key];
    text += "\n";
  }
  return text;
}

std::string FormTable(const RecordsBundle& bundle) {
  const auto trainees = ById(bundle.trainees, &TraineeRow::id);
  const auto attempts = ById(bundle.attempts, &AttemptRecord::id);
  std::string text =
      fmt::format("{}attempt,rater,blinded,made,item,score,comment\n", kFormTableHead);
  for (const FormRow& form : bundle.forms) {
    const auto attempt = attempts.find(form.attempt);
    std::string code;
    if (attempt != attempts.end() && trainees.contains(attempt->second->trainee))
      code = trainees.at(attempt->second->trainee)->code;
    for (const FormItemRow& item : form.items)
      text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", CsvField(form.form), form.form_version,
                          CsvField(code), form.attempt, CsvField(form.rater), form.blinded ? 1 : 0,
                          form.made, CsvField(item.item),
                          item.score < 0 ? "" : std::to_string(item.score), CsvField(form.comment));
  }
  return text;
}

}  // namespace arthro::app
