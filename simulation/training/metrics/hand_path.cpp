#include "simulation/training/metrics/hand_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// Hz at which one pass has −3 dB, so that two passes have it at 10 Hz at a frame every 10 ms.
constexpr double kCutOff = 12.249;
constexpr std::size_t kContinued = 30;  // frames
constexpr std::size_t kFewest = 3;      // frames of a path

// One pass of the filter in place, from the state in which its first value has lasted for ever.
void Pass(std::vector<double>& signal) {
  const double k = std::tan(std::numbers::pi * kCutOff * kFrameTime);
  const double scale = 1 / (1 + std::numbers::sqrt2 * k + k * k);
  const double b0 = k * k * scale, b1 = 2 * b0, b2 = b0;
  const double a1 = 2 * (k * k - 1) * scale, a2 = (1 - std::numbers::sqrt2 * k + k * k) * scale;
  double second = (b2 - a2) * signal.front();
  double first = (b1 - a1) * signal.front() + second;
  for (double& x : signal) {
    const double y = b0 * x + first;
    first = b1 * x - a1 * y + second;
    second = b2 * x - a2 * y;
    x = y;
  }
}

}  // namespace

std::vector<double> WithoutTremor(std::span<const double> signal) {
  if (signal.size() < 2) return {signal.begin(), signal.end()};
  const std::size_t more = std::min(kContinued, signal.size() - 1);
  std::vector<double> longer;
  longer.reserve(signal.size() + 2 * more);
  for (std::size_t i = more; i > 0; --i) longer.push_back(2 * signal.front() - signal[i]);
  longer.insert(longer.end(), signal.begin(), signal.end());
  for (std::size_t i = 1; i <= more; ++i)
    longer.push_back(2 * signal.back() - signal[signal.size() - 1 - i]);
  for (int pass = 0; pass < 2; ++pass) {
    Pass(longer);
    std::reverse(longer.begin(), longer.end());
  }
  const auto begin = longer.begin() + static_cast<std::ptrdiff_t>(more);
  return {begin, begin + static_cast<std::ptrdiff_t>(signal.size())};
}

std::vector<HandPath> HandPathsOf(std::span<const AttemptFrame> frames, DeviceRole role) {
  std::vector<HandPath> paths;
  const auto takes = [&](std::size_t k) {
    return !frames[k].is_paused && frames[k].tool[Index(role)].is_inside();
  };
  for (std::size_t begin = 0, end = 0; begin < frames.size(); begin = end + 1) {
    for (end = begin; end < frames.size() && takes(end);) ++end;
    if (end - begin < kFewest) continue;
    HandPath path{.first = begin, .tip = std::vector<glm::dvec3>(end - begin), .speed = {}};
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> raw;
      raw.reserve(end - begin);
      for (std::size_t k = begin; k < end; ++k)
        raw.push_back(frames[k].tool[Index(role)].tip[axis]);
      const std::vector<double> filtered = WithoutTremor(raw);
      for (std::size_t k = 0; k < filtered.size(); ++k) path.tip[k][axis] = filtered[k];
    }
    const std::size_t n = path.tip.size();
    path.speed.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, n - 1);
      path.speed[k] = glm::distance(path.tip[before], path.tip[after]) /
                      (kFrameTime * static_cast<double>(after - before));
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace arthro::simulation
