// The newest value of something, handed from one thread to one other without a lock (triple
// buffer). Exactly one writer and one reader. Neither ever waits; values that were not read in time
// are skipped.
#pragma once

#include <array>
#include <atomic>

namespace arthro {

template <class T>
class LatestValue {
 public:
  explicit LatestValue(const T& initial = T{}) : slots_{initial, initial, initial} {}

  // Writer only. T's copy must not throw on the servo path.
  void Write(const T& value) noexcept {
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  // Reader only: the newest value. The reference stays valid until the next Read.
  const T& Read() noexcept {
    if (middle_.load(std::memory_order_relaxed) & kFresh)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return slots_[front_];
  }

  // Reader only: is there a value that Read has not returned yet?
  bool HasNew() const noexcept { return (middle_.load(std::memory_order_relaxed) & kFresh) != 0; }

 private:
  static constexpr unsigned kFresh = 4, kIndex = 3;
  std::array<T, 3> slots_;
  unsigned front_ = 0, back_ = 1;
  std::atomic<unsigned> middle_{2};
};

}  // namespace arthro
