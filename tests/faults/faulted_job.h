// Jobs of the program that write, on small inputs, as the trials disturb them. Every job of
// `arthroscene --help` is among them; edit and practise are windows (window_trial.h).
#pragma once

#include <string>
#include <vector>

#include "tests/faults/fault.h"
#include "tests/hostile/samples.h"

namespace arthro::test {

struct FaultedJob {
  std::string name;
  std::vector<std::string> arguments = {};
  std::vector<std::string> earlier = {};  // make the earlier results; empty: there are none
  std::vector<std::string> outputs = {};  // names in ../out; folders end with /
  std::vector<std::string> piped = {};    // write to standard output instead; empty: as `arguments`
  // Name of a file or folder of the samples that is copied to ../out and changed there, and the
  // job that must find it whole.
  std::string in_place = {};
  std::vector<std::string> check = {};
  int exit_code = 0;     // undisturbed
  bool is_film = false;  // the next run saves what was filmed under a name of its own
  // The output grows: what there is of it must be readable. A disturbed measurement may end with a
  // refusal.
  bool is_log = false;
  bool is_slow = false;
  bool has_child = false;
  bool has_arm = false;
};

// Makes the inputs that the samples lack.
std::vector<FaultedJob> EveryFaultedJob(const Samples& samples);

// The faults that a job can meet.
std::vector<Fault> FaultsOf(const FaultedJob& job);

}  // namespace arthro::test
