// What a benchmark tells of many times: the median, and how long nearly all take.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace arthro::app {

// Of n values the ceil(share · n)-th in order: of fewer than 100 the largest is the 99th
// percentile. There must be one.
inline double Quantile(std::vector<double> values, double share) {
  const auto last = values.size() - 1;
  const auto at = std::min(last, static_cast<std::size_t>(std::max(
                                     1.0, std::ceil(share * static_cast<double>(values.size())))) -
                                     1);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

}  // namespace arthro::app
