// Runs the same work for many items on a few threads. Items are independent and write to their own
// place, so the result does not depend on the threads. The caller's thread works too and alone
// reports progress. An exception of any item stops the others and is rethrown here.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "simulation/core/crash_stack.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

template <class Item>
void ForEachIndex(int count, int threads, const Progress& progress, std::string_view stage,
                  Item&& item) {
  std::atomic<int> next{0}, done{0};
  std::atomic<bool> is_over{false};
  std::exception_ptr fault;
  std::mutex fault_guard;
  const auto work = [&](bool reports) {
    try {
      for (int i = next++; i < count && !is_over; i = next++) {
        if (reports) progress.Step(stage, static_cast<double>(done) / count);
        item(i);
        ++done;
      }
    } catch (...) {
      const std::lock_guard lock(fault_guard);
      if (!fault) fault = std::current_exception();
      is_over = true;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads && i < count; ++i)
      others.emplace_back([&] {
        const CrashStack crash_stack;
        work(false);
      });
    work(true);
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace arthro::authoring
