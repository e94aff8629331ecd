#include "simulation/scene/backdrop/relief_shares.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace arthro {
namespace {

// Bits of a float in the order of the floats.
std::uint32_t KeyOf(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
float ValueOf(std::uint32_t key) {
  return std::bit_cast<float>((key & 0x80000000u) != 0 ? key & 0x7fffffffu : ~key);
}

// Median of the standard errors of known depths, by two counts of half a key each: a map of eight
// million depths needs no copy and no order.
std::optional<double> MedianOf(const DepthMap& depth, const DepthMap& sigma, std::size_t count) {
  if (count == 0) return std::nullopt;
  std::uint32_t high = 0;
  std::size_t rank = count / 2;
  for (const int half : {1, 0}) {
    std::vector<std::size_t> counts(1u << 16, 0);
    for (std::size_t i = 0; i < depth.relief.size(); ++i) {
      if (!std::isfinite(depth.relief[i]) || !std::isfinite(sigma.relief[i])) continue;
      const std::uint32_t key = KeyOf(sigma.relief[i]);
      if (half == 1)
        ++counts[key >> 16];
      else if (key >> 16 == high)
        ++counts[key & 0xffffu];
    }
    std::uint32_t at = 0;
    while (rank >= counts[at]) rank -= counts[at++];
    if (half == 0) return static_cast<double>(ValueOf(high << 16 | at));
    high = at;
  }
  return std::nullopt;
}

}  // namespace

ReliefShares SharesOf(const DepthMap& depth, const DepthMap& sigma, const OriginMap& origins) {
  ReliefShares shares;
  std::array<std::size_t, 4> counts{};
  std::size_t known = 0, without_sigma = 0;
  for (std::size_t i = 0; i < depth.relief.size(); ++i) {
    if (!std::isfinite(depth.relief[i])) continue;
    ++known;
    if (i < origins.origin.size()) ++counts[static_cast<std::size_t>(origins.origin[i])];
    if (!(i < sigma.relief.size() && std::isfinite(sigma.relief[i]))) ++without_sigma;
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
  if (sigma.relief.size() == depth.relief.size())
    shares.median_sigma = MedianOf(depth, sigma, known - without_sigma);
  return shares;
}

}  // namespace arthro
