// A trainee's attempts at one exercise over time, with one value of each: what the learning curve
// and CUSUM are drawn from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/attempts/standings.h"
#include "app/records/store/records.h"

namespace arthro::app {

struct AttemptPoint {
  std::string id, started, rig;  // rig: of its session
  AttemptMode mode = AttemptMode::kPractice;
  AttemptOutcome outcome = AttemptOutcome::kStopped;
  std::optional<double> value;  // SI; none: it was not measured
};

// Oldest first, without attempts that run. `part` empty: any part.
std::vector<AttemptPoint> ProgressOf(Records& records, const std::string& trainee_code,
                                     const std::string& exercise_hash, const std::string& metric,
                                     const std::string& part,
                                     Performers performers = Performers::kPeople);

}  // namespace arthro::app
