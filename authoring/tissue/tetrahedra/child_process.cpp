#include "authoring/tissue/tetrahedra/child_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCannotExec = 127;           // exit status of a shell for it
constexpr std::size_t kMostOutput = 4096;  // bytes kept of a child's output

// File descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { Close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  void Close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

// Runs in the child, after fork: only async-signal-safe calls.
[[noreturn]] void Become(const char* program, char* const* arguments, int output, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kCannotExec);  // the parent died in between
  ::setpgid(0, 0);  // Ctrl-C then reaches the parent alone, which ends the child in an orderly way
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int null = ::open("/dev/null", O_RDONLY);
  ::dup2(null, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::close_range(3, ~0U, 0);
  ::execv(program, arguments);
  ::_exit(kCannotExec);
}

void KeepEnd(std::string& text, const char* more, std::size_t size) {
  text.append(more, size);
  if (text.size() > kMostOutput) text.erase(0, text.size() - kMostOutput);
}

}  // namespace

ChildResult RunChild(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, double time_limit,
                     const Progress& progress) {
  std::vector<char*> list = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(Code::kFile, fmt::format("no pipe could be opened: {}", std::strerror(errno)));
  Descriptor output(ends[0]), input(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    throw Error(
        Code::kFile,
        fmt::format("no process could be started: {}; close other programs", std::strerror(errno)),
        program);
  if (child == 0) Become(program.c_str(), list.data(), input.get(), parent);
  input.Close();

  // The pipe closes when the child ends, which wakes this up at once.
  ChildResult result;
  const auto deadline = Clock::now() + std::chrono::duration<double>(time_limit);
  bool stopped = false, timed_out = false;
  std::array<char, 1024> buffer;
  while (true) {
    pollfd watched{output.get(), POLLIN, 0};
    ::poll(&watched, 1, 50);
    stopped = progress.ShouldStop();
    timed_out = Clock::now() > deadline;
    if (stopped || timed_out) break;
    if ((watched.revents & (POLLIN | POLLHUP | POLLERR)) == 0) continue;
    const ssize_t size = ::read(output.get(), buffer.data(), buffer.size());
    if (size > 0) KeepEnd(result.output, buffer.data(), static_cast<std::size_t>(size));
    if (size == 0 || (size < 0 && errno != EINTR && errno != EAGAIN)) break;
  }
  if (stopped || timed_out) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (stopped) throw Error(Code::kCancelled, "stopped; nothing was written");
  if (timed_out) {
    result.end = ChildResult::End::kTimedOut;
  } else if (WIFSIGNALED(status)) {
    result.end = ChildResult::End::kSignalled;
    result.code = WTERMSIG(status);
  } else {
    result.code = WEXITSTATUS(status);
    if (result.code == kCannotExec)
      throw Error(Code::kFile, "this program could not be started; install it again", program);
  }
  return result;
}

}  // namespace arthro::authoring
