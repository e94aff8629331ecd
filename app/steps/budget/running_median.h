// Median and largest of the newest durations, in s. A plain value, allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace arthro::app {

class RunningMedian {
 public:
  void Add(double seconds) { newest_[added_++ % kKept] = seconds; }
  bool empty() const { return added_ == 0; }
  // 0 without durations; of an even number the upper of the middle two.
  double median() const {
    const std::size_t count = std::min(added_, kKept);
    if (count == 0) return 0;
    std::array<double, kKept> sorted = newest_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(sorted.begin(), middle, end);
    return *middle;
  }
  double largest() const {
    const std::size_t count = std::min(added_, kKept);
    return count == 0 ? 0
                      : *std::max_element(newest_.begin(),
                                          newest_.begin() + static_cast<std::ptrdiff_t>(count));
  }

 private:
  static constexpr std::size_t kKept = 61;  // about two seconds of pictures at 30 per second
  std::array<double, kKept> newest_{};
  std::size_t added_ = 0;
};

}  // namespace arthro::app
