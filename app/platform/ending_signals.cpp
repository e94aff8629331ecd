#include "app/platform/ending_signals.h"

#include <csignal>
#include <pthread.h>
#include <utility>

namespace arthro::app {
namespace {

sigset_t Ending() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

}  // namespace

EndingSignals::EndingSignals(std::function<void()> wake) : wake_(std::move(wake)) {
  // Blocked everywhere, they wait for the one thread that asks for them.
  const sigset_t signals = Ending();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  thread_ = std::thread([this] {
    const sigset_t mine = Ending();
    for (;;) {
      int signal = 0;
      sigwait(&mine, &signal);
      if (stop_) return;
      if (came_.exchange(signal) != 0) {
        std::signal(signal, SIG_DFL);
        pthread_sigmask(SIG_UNBLOCK, &mine, nullptr);
        raise(signal);
      }
      wake_();
    }
  });
}

EndingSignals::~EndingSignals() {
  stop_ = true;
  pthread_kill(thread_.native_handle(), SIGHUP);  // wakes it
  thread_.join();
  const sigset_t signals = Ending();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  if (const int signal = came_.load(); signal != 0) {
    std::signal(signal, SIG_DFL);
    raise(signal);
  }
}

}  // namespace arthro::app
