#include "tests/hostile/child_run.h"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

#include "simulation/core/atomic_file.h"

namespace arthro::test {
namespace {

void Limit(decltype(RLIMIT_CPU) what, rlim_t value) {
  rlimit limit{value, value};
  ::setrlimit(what, &limit);
}

[[noreturn]] void BecomeProgram(const ChildCommand& command, const std::vector<char*>& arguments,
                                const std::vector<char*>& environment, const std::string& out,
                                const std::string& err) {
  ::setpgid(0, 0);
  // A test that runs in the background of a shell has some of them ignored, and so would the
  // program.
  for (const int signal : {SIGINT, SIGQUIT, SIGHUP, SIGTERM, SIGPIPE}) ::signal(signal, SIG_DFL);
  const int in_file = ::open("/dev/null", O_RDONLY);
  const int out_file = command.out_file >= 0
                           ? command.out_file
                           : ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(in_file, 0);
  ::dup2(out_file, 1);
  ::dup2(err_file, 2);
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(command.cpu_s) + 1);
  if (command.address_bytes > 0) Limit(RLIMIT_AS, command.address_bytes);
  if (::chdir(command.folder.c_str()) == 0)
    ::execve(arguments[0], arguments.data(), environment.data());
  ::_exit(127);
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

ChildRun RunChild(const ChildCommand& command,
                  const std::function<void(int group, double seconds)>& while_running) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::string> argument_texts = command.arguments;
  std::vector<std::string> environment_texts = command.environment;
  environment_texts.push_back("PATH=/usr/bin:/bin");
  const std::vector<char*> arguments = Pointers(argument_texts);
  const std::vector<char*> environment = Pointers(environment_texts);
  const std::string out = command.scratch / "stdout", err = command.scratch / "stderr";
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) BecomeProgram(command, arguments, environment, out, err);
  ::setpgid(child, child);  // in both, since either may come first

  ChildRun run;
  int status = 0;
  rusage usage{};
  while (true) {
    const pid_t ended = ::wait4(child, &status, WNOHANG, &usage);
    if (ended == child) break;
    if (while_running) while_running(child, seconds());
    if (seconds() > command.wall_s && !run.was_too_long) {
      run.was_too_long = true;
      ::kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(while_running ? 200 : 4000));
  }
  // Its own children end with it.
  ::kill(-child, SIGKILL);
  run.wall_s = seconds();
  if (WIFEXITED(status))
    run.exit_code = WEXITSTATUS(status);
  else
    run.signal = WTERMSIG(status);
  const auto time = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  run.cpu_s = time(usage.ru_utime) + time(usage.ru_stime);
  run.peak_mb = 1024e-6 * static_cast<double>(usage.ru_maxrss);
  if (command.out_file < 0) run.out = ReadWholeFile(out);
  run.err = ReadWholeFile(err);
  return run;
}

std::string Printable(const std::string& text, std::size_t most) {
  std::string printable;
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f)
      printable += c;
    else
      printable += c == '\n' ? "\\n" : fmt::format("\\x{:02x}", byte);
  }
  return text.size() > most ? printable + fmt::format("... ({} bytes)", text.size()) : printable;
}

}  // namespace arthro::test
