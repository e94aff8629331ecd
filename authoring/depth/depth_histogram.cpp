#include "authoring/depth/depth_histogram.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {

double PercentileAt(const DepthHistogram& histogram, double place) {
  const double at = std::clamp(place, 0.0, 1.0) * DepthHistogram::kBins;
  const int whole = std::min(static_cast<int>(at), DepthHistogram::kBins - 1);
  double below = 0;
  for (int bin = 0; bin < whole; ++bin) below += histogram.share[static_cast<std::size_t>(bin)];
  below += (at - whole) * histogram.share[static_cast<std::size_t>(whole)];
  return std::clamp(100 * below, 0.0, 100.0);
}

double PlaceOfPercentile(const DepthHistogram& histogram, double percent) {
  const double wanted = percent / 100;
  double below = 0;
  for (int bin = 0; bin < DepthHistogram::kBins; ++bin) {
    const double share = histogram.share[static_cast<std::size_t>(bin)];
    if (share > 0 && below + share >= wanted)
      return (bin + std::clamp((wanted - below) / share, 0.0, 1.0)) / DepthHistogram::kBins;
    below += share;
  }
  return 1;
}

}  // namespace arthro::authoring
