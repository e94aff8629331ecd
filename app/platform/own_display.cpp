#include "app/platform/own_display.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr int kStartLimit = 20000;  // ms

// Xvfb writes the number of its display into the pipe; it closes it where it cannot start.
std::string NumberFrom(int pipe) {
  std::string number;
  for (;;) {
    pollfd wait{pipe, POLLIN, 0};
    const int ready = ::poll(&wait, 1, kStartLimit);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return "";
    char letter = 0;
    if (::read(pipe, &letter, 1) != 1) return "";
    if (letter == '\n') return number;
    number += letter;
  }
}

}  // namespace

bool HasDisplay() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"})
    if (const char* value = std::getenv(name); value != nullptr && *value != '\0') return true;
  return false;
}

OwnDisplay::OwnDisplay(int width, int height) {
  int ends[2] = {-1, -1};
  if (::pipe(ends) != 0) throw Error(Code::kDisplay, "no pipe to a display could be made");
  const std::string screen = fmt::format("{}x{}x24", width, height), end = std::to_string(ends[1]);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    // It ends with this program, however that ends.
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);
    ::close(ends[0]);
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
    ::execlp("Xvfb", "Xvfb", "-displayfd", end.c_str(), "-screen", "0", screen.c_str(), "-noreset",
             "-nolisten", "tcp", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(ends[1]);
  const std::string number = process_ > 0 ? NumberFrom(ends[0]) : "";
  ::close(ends[0]);
  if (number.empty()) {
    if (process_ > 0) {
      ::kill(process_, SIGTERM);
      ::waitpid(process_, nullptr, 0);
    }
    throw Error(Code::kDisplay,
                "there is no display, and Xvfb could not be started to make one; install the "
                "package xvfb, or run the script where there is a display");
  }
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before any thread of the window begins
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

OwnDisplay::~OwnDisplay() {
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

}  // namespace arthro::app
