// One thread that does one piece of work at a time beside its owner; or, without a thread, does it
// at once, so that a caller has the same results with and without. Start and Wait allocate nothing.
#pragma once

#include <semaphore>
#include <thread>

#include "simulation/core/crash_stack.h"

namespace arthro {

class BackgroundWorker {
 public:
  using Work = void (*)(void* subject) noexcept;

  explicit BackgroundWorker(bool has_thread) {
    if (has_thread) thread_ = std::jthread([this] { Run(); });
  }
  ~BackgroundWorker() {
    Wait();
    work_ = nullptr;
    if (thread_.joinable()) start_.release();
  }
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;

  // The work before must have been waited for.
  void Start(Work work, void* subject) noexcept {
    Wait();
    work_ = work;
    subject_ = subject;
    if (!thread_.joinable()) return work(subject);
    is_busy_ = true;
    start_.release();
  }

  // Until the work is done; at once when there is none.
  void Wait() noexcept {
    if (!is_busy_) return;
    done_.acquire();
    is_busy_ = false;
  }

 private:
  void Run() noexcept {
    const CrashStack crash_stack;
    for (;;) {
      start_.acquire();
      if (work_ == nullptr) return;
      work_(subject_);
      done_.release();
    }
  }

  Work work_ = nullptr;
  void* subject_ = nullptr;
  bool is_busy_ = false;  // owner's side
  std::binary_semaphore start_{0}, done_{0};
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace arthro
