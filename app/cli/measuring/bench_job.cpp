// arthroscene bench: replaces this process with the sibling program arthroscene-bench, so that what
// the benchmarks link (OpenCV's stitcher, reference solutions) is no part of the program.
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/cli/jobs.h"
#include "simulation/core/error.h"

namespace arthro::app {

void AddBenchJob(CLI::App& program) {
  program.add_subcommand("bench",
                         "Measure speed and error side by side, on inputs whose truth is known.");
}

int RunBenchProgram(char** arguments) {
  std::error_code fault;
  std::string bench =
      std::filesystem::read_symlink("/proc/self/exe", fault).replace_filename(kBenchProgram);
  std::vector<char*> words{bench.data()};
  while (*arguments != nullptr) words.push_back(*arguments++);
  words.push_back(nullptr);
  ::execv(bench.c_str(), words.data());
  const std::string why =
      errno == ENOENT ? "it is not installed" : std::generic_category().message(errno);
  std::fprintf(stderr, "arthroscene: %s\n",
               PrintableLine("the benchmarks are a program of their own, " + bench +
                             ", which could not be started: " + why +
                             "; install or build arthroscene-bench beside arthroscene")
                   .c_str());
  return 1;
}

}  // namespace arthro::app
