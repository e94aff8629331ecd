// Histogram of durations in fixed bins, 32 per doubling, from 0.1 µs to 1.7 s. A quantile is exact
// to 1/32. s; a plain value, allocates nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace arthro::simulation {

class TimeHistogram {
 public:
  // Counts a negative or NaN duration as 0.
  void Add(double seconds) noexcept {
    const double place = seconds > kLeast ? kPerDoubling * std::log2(seconds / kLeast) : 0.0;
    ++bins_[static_cast<std::size_t>(std::min(place, static_cast<double>(kBins - 1)))];
    ++count_;
    if (seconds > largest_) largest_ = seconds;
  }
  // Upper end of the bin of the quantile; 0 without counts.
  double Quantile(double share) const noexcept {
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      seen += bins_[i];
      if (seen > 0 && static_cast<double>(seen) >= share * static_cast<double>(count_))
        return std::min(largest_, kLeast * std::exp2(static_cast<double>(i + 1) / kPerDoubling));
    }
    return 0.0;
  }
  double largest() const noexcept { return largest_; }
  std::int64_t count() const noexcept { return count_; }

 private:
  static constexpr double kLeast = 1e-7, kPerDoubling = 32;
  static constexpr int kBins = 24 * 32;  // 1.7 s
  std::array<std::uint32_t, kBins> bins_{};
  std::int64_t count_ = 0;
  double largest_ = 0;
};

}  // namespace arthro::simulation
