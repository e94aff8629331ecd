#include "app/cli/run_jobs.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr int kDone = 0, kRefused = 1, kUsage = 2;

// Wrong use in one line, whatever was typed.
std::string UsageLine(const CLI::App* program, const CLI::Error& error) {
  std::string sentence = error.what();
  std::replace_if(
      sentence.begin(), sentence.end(),
      [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; }, ' ');
  return "arthroscene: " + sentence + "; `" + program->get_name() +
         " JOB --help` says what a job takes\n";
}

int Refuse(const std::exception& fault) {
  std::fprintf(stderr, "arthroscene: %s\n", PrintableLine(DescribeFault(fault)).c_str());
  return kRefused;
}

}  // namespace

int RunJobs(CLI::App& program, int argc, char** argv, const std::function<void()>& without_job) {
  program.failure_message(UsageLine);
  try {
    program.parse(argc, argv);
    if (without_job && program.get_subcommands().empty()) without_job();
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
