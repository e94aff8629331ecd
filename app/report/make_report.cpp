#include "app/report/make_report.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/records/attempts/attempts.h"
#include "app/records/attempts/records_file.h"
#include "app/records/keeping/expert_attempt.h"
#include "app/records/keeping/kept_attempt.h"
#include "app/records/people/reference_groups.h"
#include "simulation/core/error.h"
#include "simulation/scene/json/exercise_json.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/score/criteria.h"
#include "simulation/training/steps/step_words.h"

namespace arthro::app {
namespace {

void SetExercise(AttemptReport& report, const Exercise& exercise) {
  report.goal = exercise.brief;
  report.targets = exercise.targets;
  for (std::size_t i = 0; i < exercise.steps.size(); ++i)
    report.steps[BaseOf(exercise.steps[i]).id] = {i + 1, simulation::StepTitle(exercise.steps[i])};
}

const simulation::Metric* MetricOf(const std::string& id) {
  for (const simulation::Metric& metric : simulation::EveryMetric())
    if (metric.id == id) return &metric;
  return nullptr;
}

ReferenceGroup FindGroup(Records& records, const std::string& name, const ExerciseRow& exercise,
                         const std::string& rig) {
  const auto groups = ReferenceGroupsOf(records);
  std::vector<std::string> names;
  std::string other_rig;
  for (const ReferenceGroup& group : groups) {
    if (group.exercise != exercise.hash) continue;
    if (group.name == name && RigOf(group) == rig) return group;
    if (group.name == name) other_rig = RigOf(group);
    names.push_back(group.name);
  }
  if (!other_rig.empty())
    throw Error(
        Code::kBadArgument,
        fmt::format("the attempts of the reference group {} were made with {}, and this one "
                    "with {}; they are not compared. Choose a group with the same rig",
                    name, other_rig, rig.empty() ? "a rig that is not known" : rig));
  throw Error(Code::kBadArgument,
              names.empty()
                  ? fmt::format("the records hold no reference group for this version of the "
                                "exercise {}; make one with `arthroscene records reference`",
                                exercise.id)
                  : fmt::format("the records hold no reference group {} for the exercise {}; there "
                                "are: {}",
                                name, exercise.id, fmt::join(names, ", ")));
}

}  // namespace

void SortMetrics(std::vector<MetricRow>& rows) {
  const auto place = [](const MetricRow& row) {
    const simulation::Metric* metric = MetricOf(row.name);
    return metric == nullptr ? std::ssize(simulation::EveryMetric())
                             : metric - simulation::EveryMetric().data();
  };
  std::ranges::stable_sort(rows, {}, place);
}

AttemptReport MakeReport(const Exercise& exercise, const simulation::AttemptResult& result,
                         std::vector<simulation::AttemptFrame> frames) {
  AttemptReport report;
  report.exercise = ExerciseRowOf(exercise);
  report.is_mode_known = false;
  report.frames = std::move(frames);
  report.attempt.metrics_version = simulation::kMetricsVersion;
  SetResult(report.attempt, result);
  SetExercise(report, exercise);
  return report;
}

AttemptReport ReportFromRecords(Records& records, const std::string& attempt, std::string& notice) {
  const RecordsBundle bundle = ReadBundleOf(records, attempt);
  AttemptReport report;
  report.attempt = bundle.attempts.at(0);
  SortMetrics(report.attempt.metrics);
  report.exercise = bundle.exercises.at(0);
  report.trainee = bundle.trainees.at(0).code;
  report.station = bundle.sessions.at(0).station;
  report.rig = bundle.sessions.at(0).rig;
  report.program = bundle.sessions.at(0).program;
  try {
    SetExercise(report, ExerciseFromJson(report.exercise.json));
    auto recording = simulation::ReadAttempt(records.folder() / report.attempt.log);
    report.frames = std::move(recording.frames);
    report.track = std::move(recording.track);
  } catch (const Error& fault) {
    notice = fmt::format("the frames are left out: {}", fault.what());
  }
  return report;
}

void SetExpert(AttemptReport& report, const LoadedScene& loaded, const Exercise& exercise,
               Records* records) {
  const auto found = FindExpertFile(loaded, exercise, records, report.attempt.id);
  if (!found) return;
  AttemptRecord expert;
  SetResult(expert, ReadExpert(loaded, exercise, found->file).result);
  report.expert = std::move(expert.metrics);
}

std::vector<GroupStanding> StandingsIn(Records& records, const ReferenceGroup& group,
                                       const AttemptRecord& attempt) {
  const auto members = MemberValues(records, group);
  std::vector<GroupStanding> standings;
  for (const ReferenceValueRow& row : group.values) {
    GroupStanding& standing = standings.emplace_back();
    standing = {row.metric, row.part, row.n, row.median, row.q1, row.q3, {}};
    const auto own = std::find_if(
        attempt.metrics.begin(), attempt.metrics.end(),
        [&](const MetricRow& each) { return each.name == row.metric && each.part == row.part; });
    const simulation::Metric* metric = MetricOf(row.metric);
    const auto values = members.find({row.metric, row.part});
    // Only an attempt that came to its end is held against others.
    const bool is_whole =
        attempt.outcome == AttemptOutcome::kPassed || attempt.outcome == AttemptOutcome::kFailed;
    if (is_whole && own != attempt.metrics.end() && own->value && metric != nullptr &&
        values != members.end())
      standing.z = simulation::ZValue(*metric, *own->value, values->second);
  }
  return standings;
}

void SetGroup(AttemptReport& report, Records& records, const std::string& group) {
  const ReferenceGroup found = FindGroup(records, group, report.exercise, report.rig);
  if (found.metrics_version != report.attempt.metrics_version)
    throw Error(Code::kBadData,
                fmt::format("the reference group {} has metrics of version {}, and this attempt of "
                            "version {}; make the group anew with `arthroscene records reference`",
                            group, found.metrics_version, report.attempt.metrics_version));
  report.group = group;
  report.standings = StandingsIn(records, found, report.attempt);
}

}  // namespace arthro::app
