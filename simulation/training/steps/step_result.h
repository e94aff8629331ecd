// Result of one step of an attempt. s after the begin of the attempt.
#pragma once

#include <optional>
#include <string>

namespace arthro::simulation {

enum class StepOutcome { kPending, kRunning, kDone, kFailed };

struct StepResult {
  std::string id;
  StepOutcome outcome = StepOutcome::kPending;
  double began = 0;
  std::optional<double> ended;
};

}  // namespace arthro::simulation
