// Histogram of what a depth estimator ranks: greys for the paper's estimator, nearness (shortest
// distance over distance) for the others, from dark or far to bright or near.
#pragma once

#include <array>
#include <cstddef>

#include "authoring/depth/depth_options.h"
#include "simulation/scene/image.h"

namespace arthro::authoring {

struct DepthHistogram {
  static constexpr int kBins = 128;
  std::array<double, kBins> share{};  // share of the imaged pixels; all 0 where nothing was imaged
};

// Bins of the values from 0 to `most`; values below 0 do not count.
template <class Values>
DepthHistogram HistogramOfValues(const Values& values, double most) {
  DepthHistogram histogram;
  double count = 0;
  for (const auto value : values) {
    const double share = static_cast<double>(value) / most;
    if (!(share >= 0 && share <= 1)) continue;
    const int bin = static_cast<int>(share * DepthHistogram::kBins);
    histogram.share[static_cast<std::size_t>(
        bin < DepthHistogram::kBins ? bin : DepthHistogram::kBins - 1)] += 1;
    ++count;
  }
  if (count > 0)
    for (double& share : histogram.share) share /= count;
  return histogram;
}

// Percentile below a place from 0 (dark) to 1 (bright), and the other way round. Within a bin the
// pixels are spread evenly.
double PercentileAt(const DepthHistogram& histogram, double place);
double PlaceOfPercentile(const DepthHistogram& histogram, double percent);

}  // namespace arthro::authoring
