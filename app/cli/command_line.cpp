#include "app/cli/command_line.h"

#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr int kDone = 0, kRefused = 1, kUsage = 2;

int Refuse(const std::exception& fault) {
  std::fprintf(stderr, "arthroscene: %s\n", PrintableLine(DescribeFault(fault)).c_str());
  return kRefused;
}

}  // namespace

int RunCommandLine(int argc, char** argv) {
  CLI::App program("Arthroscene: arthroscopy training made from surgical video.", "arthroscene");
  program.set_version_flag("--version", "arthroscene " ARTHRO_VERSION);
  program.set_help_all_flag("--help-all", "Help of every job");
  program.footer("`arthroscene JOB --help` says what a job takes.");
  program.require_subcommand(1);
  AddEveryJob(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kUsage;
  } catch (const std::system_error& fault) {
    if (std::ferror(stdout) == 0) return Refuse(fault);
    return Refuse(Error(Code::kFile, "standard output could not be written to its end: " +
                                         WhyNotWritten(fault.code().value())));
  } catch (const std::exception& fault) {
    return Refuse(fault);
  }
  return kDone;
}

}  // namespace arthro::app
