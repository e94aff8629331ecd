#include "app/platform/ending_signals.h"

#include <pthread.h>
#include <utility>

namespace arthro::app {

EndingSignals::EndingSignals(std::function<void()> wake) : wake_(std::move(wake)) {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) continue;
    sigaddset(&signals_, signal);
    wake_up_ = signal;
  }
  if (wake_up_ == 0) return;
  // Blocked everywhere, they wait for the one thread that asks for them.
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  thread_ = std::thread([this] {
    for (;;) {
      int signal = 0;
      sigwait(&signals_, &signal);
      if (stop_) return;
      if (came_.exchange(signal) != 0) {
        // Acts as if it had never been blocked: a handler that releases devices still runs.
        pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
        raise(signal);
      }
      wake_();
    }
  });
}

EndingSignals::~EndingSignals() {
  if (wake_up_ == 0) return;
  stop_ = true;
  pthread_kill(thread_.native_handle(), wake_up_);
  thread_.join();
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
  if (const int signal = came_.load(); signal != 0) raise(signal);
}

}  // namespace arthro::app
