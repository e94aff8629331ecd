#include "simulation/scene/backdrop/relief_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace arthro {

ReliefShares SharesOf(const DepthMap& depth, const DepthMap& sigma, const OriginMap& origins) {
  ReliefShares shares;
  std::array<std::size_t, 4> counts{};
  std::size_t known = 0, without_sigma = 0;
  std::vector<float> errors;
  for (std::size_t i = 0; i < depth.relief.size(); ++i) {
    if (!std::isfinite(depth.relief[i])) continue;
    ++known;
    if (i < origins.origin.size()) ++counts[static_cast<std::size_t>(origins.origin[i])];
    if (i < sigma.relief.size() && std::isfinite(sigma.relief[i]))
      errors.push_back(sigma.relief[i]);
    else
      ++without_sigma;
  }
  if (known == 0) return shares;
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(known);
  };
  if (!origins.empty()) {
    shares.without_origin = share(counts[static_cast<std::size_t>(ReliefOrigin::kNone)]);
    shares.measured = share(counts[static_cast<std::size_t>(ReliefOrigin::kMeasured)]);
    shares.brightness = share(counts[static_cast<std::size_t>(ReliefOrigin::kBrightness)]);
    shares.interpolated = share(counts[static_cast<std::size_t>(ReliefOrigin::kInterpolated)]);
  }
  if (!sigma.empty()) shares.without_sigma = share(without_sigma);
  if (!errors.empty()) {
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    shares.median_sigma = static_cast<double>(*middle);
  }
  return shares;
}

}  // namespace arthro
