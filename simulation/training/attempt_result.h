// Result of an attempt at an exercise: outcome, steps, criteria and metrics, as it is shown,
// recorded and reported. Nothing sums it up: an attempt has no total, stars or percentage. SI
// units, s after the begin of the attempt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/training/metrics/metrics.h"
#include "simulation/training/steps/attempt_event.h"
#include "simulation/training/steps/step_result.h"

namespace arthro::simulation {

struct CriterionResult {
  std::string metric, part;
  std::optional<double> low, high;  // limits
  std::optional<double> value;      // nothing: it was not measured, so the criterion is not met
  bool is_met = false;
  std::string source;           // source of the limit
  bool is_start_value = false;  // the group it should come from is still too small
};

// Stopped: ended by the trainee. Void: device or frames failed for more than a second.
enum class AttemptOutcome { kRunning, kPassed, kFailed, kStopped, kVoid };

struct AttemptResult {
  AttemptOutcome outcome = AttemptOutcome::kRunning;
  std::string reason;   // one sentence; empty for a pass
  double duration = 0;  // s, without pauses
  std::vector<StepResult> steps;
  std::vector<CriterionResult> criteria;
  std::vector<MetricValue> metrics;
  std::vector<AttemptEvent> events;
};

}  // namespace arthro::simulation
