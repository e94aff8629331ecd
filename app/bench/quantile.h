// Quantiles of measured times.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace arthro::app {

// The ceil(share · n)-th of n ordered values: the 99th percentile of fewer than 100 values is the
// largest. Needs at least one value.
inline double Quantile(std::vector<double> values, double share) {
  const auto last = values.size() - 1;
  const auto at = std::min(last, static_cast<std::size_t>(std::max(
                                     1.0, std::ceil(share * static_cast<double>(values.size())))) -
                                     1);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

}  // namespace arthro::app
