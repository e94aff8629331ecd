// Numbers and outcomes of an attempt in the words and units of a reader: mm, degrees, mm².
#pragma once

#include <optional>
#include <string>

#include "app/records/attempts/attempt_record.h"

namespace arthro::app {

// Files hold SI units; a person reads these.
struct ShownUnit {
  double factor;  // factor of a value in SI
  std::string words;
};
ShownUnit ShownUnitOf(const std::string& unit);

// A value with its unit, such as "252 mm" for 0.252 m; "not measured" for nothing.
std::string ValueWords(const std::optional<double>& value, const std::string& unit);

// "at most 8.5 N", "at least 0.9", "between 0.5 and 3 N"; empty without a limit.
std::string LimitWords(const CriterionRow& criterion, const std::string& unit);

// Unit of a metric of the attempt; empty where it has none.
std::string UnitOf(const AttemptRecord& attempt, const std::string& metric,
                   const std::string& part);

// "Passed", "Not passed", "Stopped", "Void", each with a sentence that says why.
std::string OutcomeWords(const AttemptRecord& attempt);

// "more" or "less": which value of a metric is better; empty for a metric of another program.
const char* BetterWord(const std::string& metric);

// A metric's id without underscores: "peak force".
std::string MetricWords(const std::string& metric, const std::string& part);

}  // namespace arthro::app
