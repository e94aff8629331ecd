// A queue of fixed length from one thread to one other, without locks: neither side waits, and none
// allocates once it is made. What finds it full is not taken.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace arthro {

template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t length) : slots_(length) {}

  // The one side. False: it is full. T's copy must not throw on the servo path.
  bool Push(const T& value) noexcept {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[end % slots_.size()] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  // Any thread: how many it took so far.
  std::uint64_t pushed() const noexcept { return end_.load(std::memory_order_acquire); }

  // The other side: the oldest one, which stays until Pop; nullptr: there is none.
  const T* Front() const noexcept {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return nullptr;
    return &slots_[begin % slots_.size()];
  }
  void Pop() noexcept {
    begin_.store(begin_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

 private:
  std::vector<T> slots_;
  std::atomic<std::uint64_t> begin_{0}, end_{0};
};

}  // namespace arthro
