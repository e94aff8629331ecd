#include "app/report/attempt_words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/core/units.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
namespace {

// Rounding of sums leaves values below this, which say nothing about an attempt, in shown units.
constexpr double kLeastShown = 5e-5;

// Four digits, and whole numbers as such.
std::string Digits(double value) {
  if (std::abs(value) < kLeastShown) return "0";
  return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string WithUnit(const std::string& digits, const std::string& unit) {
  return unit.empty() ? digits : fmt::format("{} {}", digits, unit);
}

}  // namespace

ShownUnit ShownUnitOf(const std::string& unit) {
  if (unit == "m") return {1e3, "mm"};
  if (unit == "m2") return {1e6, "mm²"};
  if (unit == "m3") return {1e9, "mm³"};
  if (unit == "rad") return {1 / kRadianPerDegree, "°"};
  return {1, unit};
}

std::string ValueWords(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "not measured";
  const ShownUnit shown = ShownUnitOf(unit);
  return WithUnit(Digits(*value * shown.factor), shown.words);
}

std::string LimitWords(const CriterionRow& criterion, const std::string& unit) {
  const ShownUnit shown = ShownUnitOf(unit);
  if (criterion.low && criterion.high)
    return WithUnit(fmt::format("between {} and {}", Digits(*criterion.low * shown.factor),
                                Digits(*criterion.high * shown.factor)),
                    shown.words);
  if (criterion.high) return "at most " + ValueWords(criterion.high, unit);
  if (criterion.low) return "at least " + ValueWords(criterion.low, unit);
  return "";
}

std::string UnitOf(const AttemptRecord& attempt, const std::string& metric,
                   const std::string& part) {
  for (const MetricRow& row : attempt.metrics)
    if (row.name == metric && (row.part == part || part.empty())) return row.unit;
  return "";
}

std::string OutcomeWords(const AttemptRecord& attempt) {
  const auto with = [&](const char* words) {
    return attempt.reason.empty() ? words + std::string(".")
                                  : fmt::format("{}. {}", words, attempt.reason);
  };
  switch (attempt.outcome) {
    case AttemptOutcome::kPassed:
      return with(attempt.criteria.empty() ? "Done; this exercise has no criteria"
                                           : "Passed: every criterion is met");
    case AttemptOutcome::kFailed:
      return with("Not passed");
    case AttemptOutcome::kStopped:
      return with("Stopped");
    case AttemptOutcome::kVoid:
      return with("Void: it does not count");
    case AttemptOutcome::kRunning:
      return with("Running");
  }
  return "";
}

const char* BetterWord(const std::string& metric) {
  for (const simulation::Metric& known : simulation::EveryMetric())
    if (known.id == metric) return known.is_more_better ? "more" : "less";
  return "";
}

std::string MetricWords(const std::string& metric, const std::string& part) {
  std::string words = metric;
  std::replace(words.begin(), words.end(), '_', ' ');
  return part.empty() || part == "both" ? words : fmt::format("{} ({})", words, part);
}

}  // namespace arthro::app
