#include "app/records/attempts/standings.h"

#include <map>
#include <utility>

#include <fmt/format.h>

namespace arthro::app {
namespace {

// Counts by trainee and exercise, from the index alone; names are joined to the few groups.
constexpr const char* kStandings =
    R"(SELECT trainees.code, cohorts.name, counts.exercise, exercises.id, exercises.title,
    exercises.version, counts.tries, counts.passes, counts.best, counts.last, attempts.outcome,
    gates.opened
    FROM (SELECT trainee, exercise, CAST(count(*) AS BIGINT) AS tries,
    CAST(sum(CASE outcome WHEN 'passed' THEN 1 ELSE 0 END) AS BIGINT) AS passes,
    min(CASE outcome WHEN 'passed' THEN duration END) AS best, max(started) AS last
    FROM attempts WHERE mode {} 'robot' AND outcome <> 'running' {} GROUP BY trainee, exercise)
    AS counts
    JOIN trainees ON trainees.id = counts.trainee
    LEFT JOIN cohorts ON cohorts.id = trainees.cohort
    JOIN exercises ON exercises.hash = counts.exercise
    JOIN attempts ON attempts.trainee = counts.trainee AND attempts.exercise = counts.exercise
    AND attempts.started = counts.last AND attempts.mode {} 'robot'
    AND attempts.outcome <> 'running'
    LEFT JOIN gates ON gates.trainee = counts.trainee AND gates.exercise = counts.exercise {}
    ORDER BY trainees.code, exercises.id, exercises.version)";

std::vector<Standing> Ask(Records& records, const std::string& inner, const std::string& outer,
                          const Row& values, Performers performers = Performers::kPeople) {
  std::vector<Standing> standings;
  const char* mode = performers == Performers::kRobots ? "=" : "<>";
  for (const Row& row : records.database().Ask(
           fmt::format(fmt::runtime(kStandings), mode, inner, mode, outer), values)) {
    const Cell nothing;
    Standing own;
    own.trainee = TextOf(row[0]);
    own.cohort = TextOf(row[1]);
    own.exercise = TextOf(row[2]);
    own.exercise_id = TextOf(row[3]);
    own.title = TextOf(row[4]);
    own.version = static_cast<int>(WholeOf(row[5]));
    own.tries = static_cast<int>(WholeOf(row[6]));
    own.passes = static_cast<int>(WholeOf(row[7]));
    if (row[8] != nothing) own.best_time = NumberOf(row[8]);
    own.last_started = TextOf(row[9]);
    own.last_outcome = TextOf(row[10]);
    own.is_gate_opened = row[11] != nothing;
    // Attempts that an import brought may have begun in the same millisecond.
    if (!standings.empty() && standings.back().trainee == own.trainee &&
        standings.back().exercise == own.exercise)
      continue;
    standings.push_back(std::move(own));
  }
  return standings;
}

void SetTestOutcomes(Records& records, const std::string& where, const Row& values,
                     std::vector<Standing>& standings) {
  std::map<std::pair<std::string, std::string>, std::string> outcomes;  // trainee, exercise
  for (const Row& row : records.database().Ask(
           fmt::format(R"(SELECT trainees.code, attempts.exercise, attempts.outcome FROM attempts
    JOIN trainees ON trainees.id = attempts.trainee
    LEFT JOIN cohorts ON cohorts.id = trainees.cohort
    WHERE attempts.mode = 'test' AND attempts.outcome IN ('passed', 'failed') {}
    ORDER BY attempts.started, attempts.id)",
                       where),
           values))
    outcomes[{TextOf(row[0]), TextOf(row[1])}] += TextOf(row[2]) == "passed" ? 'P' : 'F';
  for (Standing& standing : standings)
    standing.test_outcomes = outcomes[{standing.trainee, standing.exercise}];
}

}  // namespace

std::vector<Standing> StandingsOf(Records& records, const std::string& trainee_code) {
  return StandingsOf(records, std::span(&trainee_code, 1));
}

std::vector<Standing> StandingsOf(Records& records, std::span<const std::string> trainee_codes,
                                  Performers performers) {
  if (trainee_codes.empty()) return {};
  std::string names;
  Row values;
  for (const std::string& code : trainee_codes) {
    names += fmt::format("{}:c{}", values.empty() ? "" : ", ", values.size());
    values.emplace_back(code);
  }
  const std::string where =
      fmt::format("AND {{}} IN (SELECT id FROM trainees WHERE code IN ({}))", names);
  const auto of = [&](const char* column) { return fmt::format(fmt::runtime(where), column); };
  auto standings = Ask(records, of("trainee"), "", values, performers);
  if (performers == Performers::kPeople)
    SetTestOutcomes(records, of("attempts.trainee"), values, standings);
  return standings;
}

std::vector<Standing> CohortStandings(Records& records, const std::string& cohort_name) {
  const bool is_one = !cohort_name.empty();
  const std::string where = is_one ? "cohorts.name = :cohort" : "";
  const Row values = is_one ? Row{cohort_name} : Row{};
  auto standings = Ask(records, "", is_one ? "WHERE " + where : "", values);
  SetTestOutcomes(records, is_one ? "AND " + where : "", values, standings);
  return standings;
}

}  // namespace arthro::app
