// Values of metrics as a person reads them, in the words of the report.
#pragma once

#include <optional>
#include <string>

#include "app/report/attempt_words.h"

namespace arthro::app {

// Value of the metric with this id.
std::string ValueOfMetric(const std::string& metric, double value);
// "at most 8.5 N"; empty without limits.
std::string LimitsOfMetric(const std::string& metric, const std::optional<double>& low,
                           const std::optional<double>& high);

}  // namespace arthro::app
