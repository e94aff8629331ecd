// Values of metrics as a person reads them, in the words of the report.
#pragma once

#include <optional>
#include <string>

#include "app/report/attempt_words.h"

namespace arthro::app {

// Value of the metric with this id, beside its limits.
std::string ValueOfMetric(const std::string& metric, const std::optional<double>& value,
                          const ValueLimits& limits = {});
// Help of the metric with this id, one sentence.
std::string MetricHelp(const std::string& metric);
// A value in the unit that a person reads, and that unit.
double ShownValueOfMetric(const std::string& metric, double value);
std::string ShownUnitOfMetric(const std::string& metric);
// "at most 8.5 N"; empty without limits.
std::string LimitsOfMetric(const std::string& metric, const ValueLimits& limits);

}  // namespace arthro::app
