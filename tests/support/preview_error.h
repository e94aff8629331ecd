// Error of a depth preview against the whole result, averaged over the pixels that each of its
// pixels covers.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "simulation/scene/image.h"

namespace arthro::test {

struct PreviewError {
  double mean = 0, p99 = 0, worst = 0;  // m, where both are imaged
  double disagree = 0;                  // share of pixels that only one of the two has imaged

  std::string Text() const {
    return fmt::format("to full: mean {:.3f}, p99 {:.3f}, worst {:.2f} mm; mask differs {:.2f} %",
                       1e3 * mean, 1e3 * p99, 1e3 * worst, 100 * disagree);
  }
};

inline PreviewError PreviewErrorOf(const DepthMap& preview, const DepthMap& whole, int factor) {
  std::vector<double> errors;
  std::size_t disagree = 0;
  for (int y = 0; y < preview.height; ++y)
    for (int x = 0; x < preview.width; ++x) {
      double sum = 0;
      int count = 0, all = 0;
      for (int v = y * factor; v < std::min(whole.height, (y + 1) * factor); ++v)
        for (int u = x * factor; u < std::min(whole.width, (x + 1) * factor); ++u) {
          ++all;
          if (std::isnan(whole.at(u, v))) continue;
          sum += whole.at(u, v);
          ++count;
        }
      const bool is_imaged = 2 * count > all;
      if (std::isnan(preview.at(x, y)) == is_imaged) ++disagree;
      if (is_imaged && !std::isnan(preview.at(x, y)))
        errors.push_back(std::abs(preview.at(x, y) - sum / count));
    }
  PreviewError error;
  error.disagree = static_cast<double>(disagree) / static_cast<double>(preview.relief.size());
  if (errors.empty()) return error;
  std::sort(errors.begin(), errors.end());
  for (const double e : errors) error.mean += e / static_cast<double>(errors.size());
  error.p99 = errors[errors.size() * 99 / 100];
  error.worst = errors.back();
  return error;
}

}  // namespace arthro::test
