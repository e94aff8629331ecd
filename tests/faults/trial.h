// Outcome of one disturbed run.
#pragma once

#include <string>
#include <vector>

#include "tests/faults/fault.h"

namespace arthro::test {

enum class TrialEnd {
  kSignal,    // ended by the signal that was sent
  kSentence,  // exit code 1 and a sentence
  kDone,      // exit code 0
  kMissed     // the moment never came: the run had ended before
};

struct Trial {
  std::string job;
  Fault fault = Fault::kKill;
  double at = 0;  // s
  TrialEnd end = TrialEnd::kDone;
  std::vector<std::string> complaints = {};
  std::string said = {};  // standard error
  double lost_s = 0;      // windows: edits that are lost
  double force_ms = 0;    // windows: from the fault to the last force
};

// Sets the end of the trial, and complains of a run that hung, ended by a signal that nobody sent,
// or said something other than a sentence.
void LookAtRun(const ChildRun& run, const Disturbance& disturbance, Trial& trial);

}  // namespace arthro::test
