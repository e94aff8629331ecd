#include "app/records/attempts/progress.h"

namespace arthro::app {
namespace {

template <class E>
E ChoiceOf(const Choices<E>& choices, const std::string& word) {
  E found = choices.words.front().first;
  for (const auto& [value, its_word] : choices.words)
    if (word == its_word) found = value;
  return found;
}

}  // namespace

std::vector<AttemptPoint> ProgressOf(Records& records, const std::string& trainee_code,
                                     const std::string& exercise_hash, const std::string& metric,
                                     const std::string& part, Performers performers) {
  std::vector<AttemptPoint> points;
  for (const Row& row : records.database().Ask(
           R"(SELECT attempts.id, attempts.started, attempts.mode, attempts.outcome, metrics.value,
    sessions.rig FROM attempts JOIN sessions ON sessions.id = attempts.session
    LEFT JOIN metrics ON metrics.attempt = attempts.id AND metrics.name = :metric
    AND (metrics.part = :part OR :any = 1)
    WHERE attempts.trainee = (SELECT id FROM trainees WHERE code = :code)
    AND attempts.exercise = :exercise AND (attempts.mode = 'robot') = (:robots = 1)
    AND attempts.outcome <> 'running' ORDER BY attempts.started, attempts.id)",
           {metric, part, static_cast<std::int64_t>(part.empty() ? 1 : 0), trainee_code,
            exercise_hash, static_cast<std::int64_t>(performers == Performers::kRobots)})) {
    AttemptPoint point;
    point.id = TextOf(row[0]);
    // With any part an attempt may have several values; the first one counts.
    if (!points.empty() && points.back().id == point.id) continue;
    point.started = TextOf(row[1]);
    point.mode = ChoiceOf(AttemptModes(), TextOf(row[2]));
    point.outcome = ChoiceOf(AttemptOutcomes(), TextOf(row[3]));
    if (!std::holds_alternative<std::monostate>(row[4])) point.value = NumberOf(row[4]);
    point.rig = TextOf(row[5]);
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace arthro::app
