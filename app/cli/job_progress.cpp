#include "app/cli/job_progress.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace arthro::app {
namespace {

// The one piece of process-wide state: a signal handler can reach nothing else.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void RequestStop(int) { stop_requested.store(true, std::memory_order_relaxed); }

}  // namespace

Progress TerminalProgress() {
  std::signal(SIGINT, RequestStop);
  std::signal(SIGTERM, RequestStop);
  if (std::signal(SIGHUP, RequestStop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // set by nohup
  Progress progress;
  progress.stop = &stop_requested;
  if (::isatty(STDERR_FILENO)) {
    progress.report = [](std::string_view stage, double done) {
      std::fprintf(stderr, "\r\033[K%3.0f %%  %.*s", 100.0 * done, static_cast<int>(stage.size()),
                   stage.data());
      if (done >= 1.0) std::fputc('\n', stderr);
      std::fflush(stderr);
    };
  }
  return progress;
}

}  // namespace arthro::app
