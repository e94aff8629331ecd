// Attempts as statements of the Experience API [IEEE 9274.1.1, xAPI 1.0.3], a file for a learning
// record store. Metrics are extensions; no score is stated, since xAPI reads a score as a share of
// a whole and an attempt has none.
#pragma once

#include <string>

#include "app/records/attempts/attempt_record.h"

namespace arthro::app {

struct XapiStatements {
  std::string text;  // a JSON list
  int left_out = 0;  // attempts that are running, stopped or void, and those of robots
};

// `home`: address of the department, such as https://lab.example, below which trainees and
// exercises are named. Throws Error(kBadArgument) where it is no address.
XapiStatements XapiOf(const RecordsBundle& bundle, const std::string& home);

}  // namespace arthro::app
