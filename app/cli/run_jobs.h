// Parses a command line, runs one job, turns faults into one sentence on stderr and an exit code
// (0 done, 1 refused, 2 usage) [method.md, Command line].
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace arthro::app {

// `program` has its jobs; `without_job` runs when the line names none of them; it may be empty.
int RunJobs(CLI::App& program, int argc, char** argv, const std::function<void()>& without_job);

}  // namespace arthro::app
