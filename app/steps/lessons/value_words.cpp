#include "app/steps/lessons/value_words.h"

#include <algorithm>
#include <string_view>

#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
namespace {

std::string UnitOfMetric(std::string_view id) {
  for (const simulation::Metric& metric : simulation::EveryMetric())
    if (metric.id == id) return std::string(metric.unit);
  return "";
}

}  // namespace

std::string ValueOfMetric(const std::string& metric, double value) {
  return ValueWords(value, UnitOfMetric(metric));
}

double ShownValueOfMetric(const std::string& metric, double value) {
  return value * ShownUnitOf(UnitOfMetric(metric)).factor;
}

std::string ShownUnitOfMetric(const std::string& metric) {
  return ShownUnitOf(UnitOfMetric(metric)).words;
}

std::string LimitsOfMetric(const std::string& metric, const std::optional<double>& low,
                           const std::optional<double>& high) {
  CriterionRow criterion;
  criterion.low = low;
  criterion.high = high;
  return LimitWords(criterion, UnitOfMetric(metric));
}

std::string TimeWords(const std::string& utc) {
  std::string words = utc.substr(0, 16);  // "2026-11-24T02:10"
  std::ranges::replace(words, 'T', ' ');
  return words;
}

}  // namespace arthro::app
