// Median of a list, 0 of an empty one; of an even number the upper of the middle two.
#pragma once

#include <algorithm>
#include <vector>

namespace arthro::authoring {

inline double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace arthro::authoring
