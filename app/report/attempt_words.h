// Outcomes, values and limits of an attempt in the records in the words and units of a reader.
#pragma once

#include <string>

#include "app/records/attempts/attempt_record.h"
#include "simulation/training/attempt_result.h"
#include "simulation/training/metrics/metric_words.h"

namespace arthro::app {

using simulation::LimitWords;
using simulation::MetricWords;
using simulation::ValueLimits;
using simulation::ValueWords;

// Limits of a criterion in the records.
inline ValueLimits LimitsOf(const CriterionRow& criterion) {
  return {criterion.low, criterion.high};
}

// Unit of a metric of the attempt; empty where it has none.
std::string UnitOf(const AttemptRecord& attempt, const std::string& metric,
                   const std::string& part);

// "Passed", "Not passed", "Stopped", "Void", each with a sentence that says why.
std::string OutcomeWords(const AttemptRecord& attempt);

// "2026-11-24 02:10" of a time of the records.
std::string TimeWords(const std::string& utc);

// "Step begins", "Hint", "Too much force": the kind of an event.
const char* EventWords(simulation::EventKind kind);
// The same by the word in the records; one of another program is kept, its lines as blanks.
std::string EventWords(const std::string& kind);

// "more" or "less": which value of a metric is better; empty for a metric of another program.
const char* BetterWord(const std::string& metric);

}  // namespace arthro::app
