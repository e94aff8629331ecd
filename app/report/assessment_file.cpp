#include "app/report/assessment_file.h"

#include <algorithm>

#include "app/records/store/json_file.h"
#include "app/report/attempt_words.h"

namespace arthro::app {
namespace {

constexpr const char* kSchema = "arthroscene.assessment/1";

AssessedGroup GroupOf(const AttemptReport& report, const MetricRow& metric) {
  const GroupStanding* standing = StandingIn(report, metric.name, metric.part);
  if (standing == nullptr) return {};
  return {static_cast<double>(standing->n), standing->median, standing->q1, standing->q3,
          standing->z};
}

}  // namespace

std::string AttemptJson(const AttemptReport& report) {
  const AttemptRecord& attempt = report.attempt;
  AssessmentFile file;
  file.attempt = attempt.id;
  file.trainee = report.trainee;
  if (HasExercise(report))
    file.exercise = {report.exercise.id, report.exercise.hash, report.exercise.title,
                     report.exercise.version};
  file.scene = attempt.scene;
  if (report.is_mode_known) file.mode = ToString(attempt.mode);
  file.started = attempt.started;
  if (HasExercise(report)) file.outcome = simulation::ToString(attempt.outcome);
  file.reason = attempt.reason;
  file.duration = attempt.duration;
  file.frames = static_cast<int>(report.frames.size());
  file.unknown_frames = static_cast<int>(std::count_if(
      report.frames.begin(), report.frames.end(),
      [](const auto& frame) { return !frame.tool[0].is_valid && !frame.tool[1].is_valid; }));
  file.metrics_version = attempt.metrics_version;
  file.group = report.group;
  for (const CriterionRow& row : attempt.criteria)
    file.criteria.push_back({row.metric, row.part, UnitOf(attempt, row.metric, row.part),
                             row.source, row.low, row.high, row.value, row.passed});
  file.steps = attempt.steps;
  for (const MetricRow& row : attempt.metrics)
    file.metrics.push_back({row.name, row.part, row.unit, BetterWord(row.name), row.why_none,
                            row.value, GroupOf(report, row)});
  file.events = attempt.events;
  return JsonFileText(std::move(file), kSchema);
}

std::string AssessmentSchema() {
  return JsonFileSchema<AssessmentFile>(kSchema, "Report of an attempt",
                                        "Outcome, criteria, steps, metrics and events of one "
                                        "attempt. SI units; s after the begin of the attempt.");
}

}  // namespace arthro::app
