#include "simulation/training/score/criteria.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "simulation/scene/scene.h"
#include "simulation/training/metrics/metric_words.h"
#include "simulation/training/steps/step_words.h"

namespace arthro::simulation {
namespace {

// The value of a criterion: of its part, or the only one of its metric.
const MetricValue* ValueOf(const Criterion& criterion, std::span<const MetricValue> values) {
  const MetricValue* found = nullptr;
  for (const MetricValue& value : values) {
    if (value.metric->id != criterion.metric) continue;
    if (!criterion.part.empty() && value.part != criterion.part) continue;
    if (found != nullptr) return nullptr;  // several parts, and the criterion names none
    found = &value;
  }
  return found;
}

std::string_view UnitOfMetric(const std::string& id) {
  for (const Metric& metric : EveryMetric())
    if (metric.id == id) return metric.unit;
  return "";
}

std::string ReasonOf(const Exercise& exercise, const AttemptResult& result) {
  for (std::size_t i = 0; i < result.steps.size(); ++i)
    if (const StepOutcome outcome = result.steps[i].outcome;
        outcome == StepOutcome::kFailed || outcome == StepOutcome::kRunning)
      return StepWords(exercise, i) + " was not done.";
  for (const CriterionResult& criterion : result.criteria) {
    if (criterion.is_met) continue;
    return CriterionWords(criterion) + ".";
  }
  return "";
}

bool IsOptional(const Exercise& exercise, const std::string& id) {
  const int index = StepIndex(exercise, id);
  return index >= 0 && BaseOf(exercise.steps[static_cast<std::size_t>(index)]).is_optional;
}

}  // namespace

std::vector<CriterionResult> JudgeCriteria(std::span<const Criterion> criteria,
                                           std::span<const MetricValue> values,
                                           std::span<const GroupValues> groups) {
  std::vector<CriterionResult> results;
  for (const Criterion& criterion : criteria) {
    CriterionResult& result = results.emplace_back();
    result.metric = criterion.metric;
    result.part = criterion.part;
    result.low = criterion.min;
    result.high = criterion.max;
    result.source = criterion.source;
    const MetricValue* value = ValueOf(criterion, values);
    if (value != nullptr) {
      result.part = value->part;
      result.value = value->value;
    }
    if (criterion.max_from) {
      const auto group = std::find_if(groups.begin(), groups.end(), [&](const GroupValues& each) {
        return each.group == criterion.max_from->group && each.metric == criterion.metric &&
               (criterion.part.empty() || each.part == criterion.part);
      });
      result.is_start_value = group == groups.end() || group->n < kSmallestGroup;
      if (!result.is_start_value) {
        result.high = group->mean + criterion.max_from->plus_sd * group->sd;
        result.source = fmt::format("{} (n = {}): mean + {:g} sd", group->group, group->n,
                                    criterion.max_from->plus_sd);
      }
    }
    result.is_met = result.value && (!result.low || *result.value >= *result.low) &&
                    (!result.high || *result.value <= *result.high);
  }
  return results;
}

std::string CriterionWords(const CriterionResult& criterion) {
  const std::string unit(UnitOfMetric(criterion.metric));
  const ValueLimits limits{criterion.low, criterion.high};
  return fmt::format("{}: {}, asked for {}", MetricWords(criterion.metric, criterion.part),
                     ValueWords(criterion.value, unit, limits), LimitWords(limits, unit));
}

AttemptResult ResultOf(const StepEngine& engine, std::vector<MetricValue> values,
                       std::span<const GroupValues> groups) {
  AttemptResult result;
  const Exercise& exercise = engine.exercise();
  result.duration = engine.duration();
  result.steps = engine.steps();
  result.events = engine.events();
  result.criteria = JudgeCriteria(exercise.criteria, values, groups);
  result.metrics = std::move(values);
  result.reason = engine.reason();
  switch (engine.end()) {
    case AttemptEnd::kRunning:
      result.outcome = AttemptOutcome::kRunning;
      return result;
    case AttemptEnd::kVoid:
      result.outcome = AttemptOutcome::kVoid;
      return result;
    case AttemptEnd::kStopped:
      result.outcome = AttemptOutcome::kStopped;
      return result;
    case AttemptEnd::kStepFailed:
    case AttemptEnd::kLimit:
      result.outcome = AttemptOutcome::kFailed;
      return result;
    case AttemptEnd::kCompleted:
      break;
  }
  const bool steps_done =
      std::all_of(result.steps.begin(), result.steps.end(), [&](const StepResult& step) {
        return step.outcome == StepOutcome::kDone || step.outcome == StepOutcome::kPending ||
               IsOptional(exercise, step.id);
      });
  const bool criteria_met =
      std::all_of(result.criteria.begin(), result.criteria.end(),
                  [](const CriterionResult& criterion) { return criterion.is_met; });
  result.outcome = steps_done && criteria_met ? AttemptOutcome::kPassed : AttemptOutcome::kFailed;
  if (result.outcome == AttemptOutcome::kFailed) result.reason = ReasonOf(exercise, result);
  return result;
}

std::optional<double> ZValue(const Metric& metric, double value, std::span<const double> values) {
  if (values.size() < static_cast<std::size_t>(kSmallestGroup)) return std::nullopt;
  const bool is_log = metric.unit == "s" || metric.unit == "m" || metric.unit == "m2";
  const auto scaled = [&](double x) { return is_log ? std::log(x) : x; };
  if (is_log && (!(value > 0) || std::any_of(values.begin(), values.end(),
                                             [](double each) { return !(each > 0); })))
    return std::nullopt;
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double each : values) mean += scaled(each) / n;
  for (const double each : values) squares += std::pow(scaled(each) - mean, 2);
  const double sd = std::sqrt(squares / (n - 1));
  // Members that differ by rounding alone do not differ.
  if (!(sd > 1e-9 * std::abs(mean)) || !(sd > 0)) return std::nullopt;
  return (metric.is_more_better ? 1 : -1) * (scaled(value) - mean) / sd;
}

std::vector<std::string> CriterionFaults(const Scene& scene) {
  std::vector<std::string> faults;
  const auto metrics = EveryMetric();
  for (std::size_t e = 0; e < scene.exercises.size(); ++e)
    for (std::size_t i = 0; i < scene.exercises[e].criteria.size(); ++i) {
      const std::string& id = scene.exercises[e].criteria[i].metric;
      if (std::none_of(metrics.begin(), metrics.end(),
                       [&](const Metric& metric) { return metric.id == id; }))
        faults.push_back(
            fmt::format("exercises[{}].criteria[{}].metric is \"{}\", which is no metric; "
                        "resources/doc/method.md "
                        "lists them under Metrics",
                        e, i, id));
    }
  return faults;
}

}  // namespace arthro::simulation
