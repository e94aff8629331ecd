// Attempts as a table (CSV): one row per attempt, one column per metric and part, with its unit. A
// missing value is an empty cell. SI units.
#pragma once

#include <string>

#include "app/records/attempts/attempt_record.h"

namespace arthro::app {

inline constexpr const char* kAttemptTableHead = "attempt,trainee,cohort,";
std::string AttemptTable(const RecordsBundle& bundle);

// One row per item of a filled form.
inline constexpr const char* kFormTableHead = "form,form_version,trainee,";
std::string FormTable(const RecordsBundle& bundle);

}  // namespace arthro::app
