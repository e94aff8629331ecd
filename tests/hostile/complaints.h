// Faults that a run of the program must never show, whatever its input was.
#pragma once

#include <string>
#include <vector>

#include "tests/hostile/child_run.h"

namespace arthro::test {

struct RunLimits {
  double cpu_s = 10;
  double peak_mb = 1000;
};

// A sentence per fault: ends, times, memory and messages. Files are looked at by FileComplaints.
std::vector<std::string> RunComplaints(const ChildRun& run, const RunLimits& limits = {});

// The faults of a job's message alone. `is_refusal`: the exit code is 1.
std::vector<std::string> MessageComplaints(const std::string& err, bool is_refusal);

// Empty, or what shows that a file of that ending was not written to its end.
std::string NotWhole(const std::string& name, const std::string& bytes);

}  // namespace arthro::test
