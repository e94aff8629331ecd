#include "app/steps/lessons/value_words.h"

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

std::string ValueOfMetric(const std::string& metric, const std::optional<double>& value,
                          const ValueLimits& limits) {
  return ValueWords(value, UnitOfMetric(metric), limits);
}

std::string MetricHelp(const std::string& metric) {
  for (const simulation::Metric& known : simulation::EveryMetric())
    if (known.id == metric) return std::string(known.help);
  return "";
}

double ShownValueOfMetric(const std::string& metric, double value) {
  return value * simulation::ShownUnitOf(UnitOfMetric(metric)).factor;
}

std::string ShownUnitOfMetric(const std::string& metric) {
  return simulation::ShownUnitOf(UnitOfMetric(metric)).words;
}

std::string LimitsOfMetric(const std::string& metric, const ValueLimits& limits) {
  return LimitWords(limits, UnitOfMetric(metric));
}

}  // namespace arthro::app
