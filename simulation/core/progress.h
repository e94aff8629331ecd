// How a long job tells how far it is and learns that it should stop. Callable from the job's
// thread.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "simulation/core/error.h"

namespace arthro {

struct Progress {
  // Called with a stage's name and the share of it that is done, 0 to 1. May be empty.
  std::function<void(std::string_view stage, double done)> report;
  // Set by whoever wants the job to stop. May be null.
  const std::atomic<bool>* stop = nullptr;

  bool ShouldStop() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }

  // Reports, and throws Error(kCancelled) when the job should stop.
  void Step(std::string_view stage, double done) const {
    if (ShouldStop()) throw Error(Code::kCancelled, "stopped; nothing was written");
    if (report) report(stage, done);
  }
};

}  // namespace arthro
