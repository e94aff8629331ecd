// Values of metrics as a person reads them, in the words of the report.
#pragma once

#include <optional>
#include <string>

#include "app/report/attempt_words.h"

namespace arthro::app {

// Value of the metric with this id.
std::string ValueOfMetric(const std::string& metric, double value);
// A value in the unit that a person reads, and that unit.
double ShownValueOfMetric(const std::string& metric, double value);
std::string ShownUnitOfMetric(const std::string& metric);
// "at most 8.5 N"; empty without limits.
std::string LimitsOfMetric(const std::string& metric, const std::optional<double>& low,
                           const std::optional<double>& high);

// "2026-11-24 02:10" of a time of the records.
std::string TimeWords(const std::string& utc);

}  // namespace arthro::app
