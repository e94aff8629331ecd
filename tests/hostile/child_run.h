// Runs a program as a child under limits and reports how it ended and what it cost. Processor time
// is limited instead of wall time, so that a busy machine changes no verdict.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace arthro::test {

struct ChildCommand {
  std::vector<std::string> arguments;  // the program's path first
  std::filesystem::path folder;        // working directory
  std::filesystem::path scratch;       // for standard output and error; not the working directory
  std::vector<std::string> environment;
  double cpu_s = 60;    // SIGXCPU ends it
  double wall_s = 600;  // SIGKILL ends it; only for what waits for ever
  std::size_t address_bytes = std::size_t{6} << 30;  // 0: no limit
  int out_file = -1;  // descriptor for standard output in place of a file of `scratch`
};

struct ChildRun {
  int exit_code = -1;  // -1: a signal ended it
  int signal = 0;
  bool was_too_long = false;  // wall_s passed
  double cpu_s = 0;           // user and system, its own children included
  double wall_s = 0;
  double peak_mb = 0;  // largest resident size, 1e6 bytes
  std::string out, err;
};

// `while_running` is called several times per millisecond with the child's process group and the
// seconds since the start.
ChildRun RunChild(const ChildCommand& command,
                  const std::function<void(int group, double seconds)>& while_running = {});

// Text with control characters, quotes kept, as \xNN; cut to `most` bytes.
std::string Printable(const std::string& text, std::size_t most = 600);

}  // namespace arthro::test
