// Ctrl-C, Ctrl-\, SIGTERM and SIGHUP as a wish to end, so that what has a window ends as by its
// close box: devices let go, files whole. Make it before any thread that must not be ended by them.
// A second one while the first is heeded ends the program at once. Signals that the program was
// started to ignore, as by nohup, stay ignored.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace arthro::app {

class EndingSignals {
 public:
  // `wake` is called by another thread when one comes.
  explicit EndingSignals(std::function<void()> wake);
  ~EndingSignals();  // the signal that came ends the program now, as it would have
  EndingSignals(const EndingSignals&) = delete;
  EndingSignals& operator=(const EndingSignals&) = delete;

  bool HasCome() const noexcept { return came_.load() != 0; }

 private:
  std::function<void()> wake_;
  sigset_t signals_;
  int wake_up_ = 0;           // one of them; 0: there are none
  std::atomic<int> came_{0};  // its number
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace arthro::app
