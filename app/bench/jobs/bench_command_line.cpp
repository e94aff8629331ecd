// Command line of arthroscene-bench. Names the jobs as `arthroscene bench`, which starts it.
#include <CLI/CLI.hpp>

#include "app/bench/jobs/bench_jobs.h"
#include "app/cli/command_line.h"
#include "app/cli/run_jobs.h"

namespace arthro::app {

int RunCommandLine(int argc, char** argv) {
  CLI::App program("Measure speed and error side by side, on inputs whose truth is known.",
                   "arthroscene bench");
  program.set_help_all_flag("--help-all", "Help of every job");
  program.footer("`arthroscene bench JOB --help` says what a job takes.");
  program.require_subcommand(1);
  AddBenches(program);
  return RunJobs(program, argc, argv, [] {});
}

}  // namespace arthro::app
