// An X server and programs on it as processes of the test, which may kill any of them.
#pragma once

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace arthro::test {

class Process {
 public:
  // `arguments[0]` is looked for in PATH; `environment` as "NAME=value". stderr goes to `errors`,
  // `passed` stays open.
  Process(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
          const std::filesystem::path& errors, int passed = -1) {
    process_ = ::fork();
    if (process_ != 0) return;
    for (const std::string& entry : environment) ::putenv(const_cast<char*>(entry.c_str()));
    if (std::freopen("/dev/null", "r", stdin) == nullptr ||
        std::freopen("/dev/null", "w", stdout) == nullptr ||
        std::freopen(errors.c_str(), "w", stderr) == nullptr)
      ::_exit(126);
    for (int other = 3; other < 64; ++other)
      if (other != passed) ::close(other);
    std::vector<char*> words;
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execvp(words[0], words.data());
    ::_exit(127);
  }
  ~Process() {
    Send(SIGKILL);
    Wait(10);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t number() const { return process_; }
  void Send(int signal) const {
    if (process_ > 0) ::kill(process_, signal);
  }
  // Its exit code, 128 + signal where one ended it, -1 when it still runs after `seconds`.
  int Wait(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (process_ > 0) {
      int status = 0;
      if (::waitpid(process_, &status, WNOHANG) == process_) {
        process_ = -1;
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      } else if (std::chrono::steady_clock::now() > end) {
        return -1;
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    }
    return exit_code_;
  }

 private:
  pid_t process_ = -1;
  int exit_code_ = -1;
};

// Xvfb on a display number that is free. Its name is empty when it could not be started.
class XServer {
 public:
  explicit XServer(const std::filesystem::path& log, const std::string& screen = "1280x1024x24") {
    int ends[2] = {-1, -1};
    if (::pipe(ends) != 0) return;
    process_ = std::make_unique<Process>(
        std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0",
                                 screen, "-noreset", "-nolisten", "tcp"},
        std::vector<std::string>{}, log, ends[1]);
    ::close(ends[1]);
    char c = 0;
    std::string number;
    while (::read(ends[0], &c, 1) == 1 && c != '\n') number += c;
    ::close(ends[0]);
    if (!number.empty()) name_ = ":" + number;
  }
  const std::string& name() const { return name_; }
  void Kill() { process_.reset(); }

 private:
  std::unique_ptr<Process> process_;
  std::string name_;
};

// Looks until `holds`, at most for `seconds`: a bound against a hang on a busy machine.
inline bool Eventually(const std::function<bool()>& holds, double seconds = 600) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

}  // namespace arthro::test
