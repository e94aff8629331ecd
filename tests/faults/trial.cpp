#include "tests/faults/trial.h"

#include <fmt/format.h>

#include "tests/hostile/complaints.h"

namespace arthro::test {

void LookAtRun(const ChildRun& run, const Disturbance& disturbance, Trial& trial) {
  trial.said = run.err;
  if (!disturbance.is_done)
    trial.end = TrialEnd::kMissed;
  else if (run.signal != 0)
    trial.end = TrialEnd::kSignal;
  else if (run.exit_code == 1)
    trial.end = TrialEnd::kSentence;
  const auto complain = [&](const std::string& words) { trial.complaints.push_back(words); };
  if (run.was_too_long)
    complain(fmt::format("hangs: {:.0f} s", run.wall_s));
  else if (run.signal != 0 && run.signal != disturbance.signal)
    complain(fmt::format("ended by signal {}", run.signal));
  if (run.exit_code > 1) complain(fmt::format("exit code {}", run.exit_code));
  for (const std::string& said : MessageComplaints(run.err, run.exit_code == 1)) complain(said);
}

}  // namespace arthro::test
