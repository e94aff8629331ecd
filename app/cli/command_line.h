// The command line: parses, runs one job, turns faults into one sentence on stderr and an exit code
// (0 done, 1 refused, 2 usage) [method.md, Command line].
#pragma once

namespace CLI {
class App;
}

namespace arthro::app {

// Gives the program its name, its description and every job.
void DescribeProgram(CLI::App& program);

int RunCommandLine(int argc, char** argv);

}  // namespace arthro::app
