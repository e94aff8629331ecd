// Disturbs jobs without a window and looks at what they leave: each output is the earlier one or
// the new one, whole; the message is one sentence; the next run works and leaves nothing behind.
#pragma once

#include <map>

#include "tests/faults/faulted_job.h"
#include "tests/faults/folder_contents.h"
#include "tests/faults/trial.h"

namespace arthro::test {

class JobTrials {
 public:
  JobTrials(const Samples& samples, const MappedFaultPage& page) : samples_(samples), page_(page) {}

  // `moment` and `strength` from 0 to 1. Throws where the undisturbed job fails.
  Trial Run(const FaultedJob& job, Fault fault, double moment, double strength);

 private:
  struct Known {
    Files earlier, now;
    double wall_s = 0;
  };
  ChildCommand CommandOf(const FaultedJob& job, const std::vector<std::string>& arguments) const;
  const Known& KnownOf(const FaultedJob& job, const std::vector<std::string>& arguments);
  ChildRun Whole(const FaultedJob& job, const std::vector<std::string>& arguments) const;
  void LookAtEnd(const FaultedJob& job, const ChildRun& run, const Disturbance& disturbance,
                 Trial& trial) const;
  void LookAtOutputs(const FaultedJob& job, const Known& known, const ChildRun& run,
                     Trial& trial) const;
  void LookAtNextRun(const FaultedJob& job, Trial& trial) const;
  std::vector<std::string> Leftovers(const FaultedJob& job) const;
  bool IsWriting(const Files& earlier) const;

  const Samples& samples_;
  const MappedFaultPage& page_;
  std::map<std::string, Known> known_;  // key: command line of the job
};

}  // namespace arthro::test
