// Runs the built program and measures what it took: time, and its greatest memory.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "tests/support/temp_folder.h"

namespace arthro::test {

struct MeasuredRun {
  int exit_code = -1;  // 128 + signal where one ended it
  std::string out, err;
  double cpu_seconds = 0, seconds = 0;
  double megabytes = 0;  // greatest resident size
};

// `environment` holds NAME=VALUE. The program is killed after `limit` seconds, a bound against a
// hang.
inline MeasuredRun RunMeasured(const std::vector<std::string>& arguments,
                               const std::vector<std::string>& environment = {},
                               unsigned limit = 600) {
  TempFolder folder;
  const std::string out = (folder / "out").string(), err = (folder / "err").string();
  std::vector<char*> words = {const_cast<char*>(ARTHRO_PROGRAM)};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    for (const std::string& variable : environment) ::putenv(const_cast<char*>(variable.c_str()));
    ::dup2(::open("/dev/null", O_RDONLY), 0);
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), 1);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), 2);
    ::alarm(limit);
    ::execv(ARTHRO_PROGRAM, words.data());
    ::_exit(127);
  }
  MeasuredRun run;
  int status = 0;
  rusage usage{};
  if (child < 0 || ::wait4(child, &status, 0, &usage) != child) return run;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  run.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const auto read = [](const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  run.out = read(out);
  run.err = read(err);
  return run;
}

}  // namespace arthro::test
