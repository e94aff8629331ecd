#include "app/cli/command_line.h"

#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/about/about.h"
#include "app/cli/jobs.h"
#include "app/cli/run_jobs.h"
#include "app/help/help_pages.h"

namespace arthro::app {

void DescribeProgram(CLI::App& program) {
  program.name("arthroscene");
  program.description("Arthroscene: arthroscopy training made from surgical video.");
  program.set_version_flag(
      "--version",
      [&program] {
        return program.count("--long") > 0 ? LongVersion(LicenceTexts())
                                           : fmt::format("arthroscene {}", Version());
      },
      "Version of the program.");
  program.add_flag("--long")->description(
      "With --version: commit, and version and licence of each library.");
  program.set_help_all_flag("--help-all", "Help of every job.");
  program.footer("`arthroscene JOB --help` says what a job takes.");
  program.require_subcommand(1);
  AddEveryJob(program);
}

int RunCommandLine(int argc, char** argv) {
  // Everything behind `bench` belongs to the sibling program, `--help` too.
  if (argc > 1 && std::string_view(argv[1]) == "bench") return RunBenchProgram(argv + 2);
  CLI::App program;
  DescribeProgram(program);
  return RunJobs(program, argc, argv, {});
}

}  // namespace arthro::app
