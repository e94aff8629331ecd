#include "simulation/training/metrics/smoothness.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {
namespace {

constexpr double kHighest = 10;      // Hz
constexpr double kFaint = 0.05;      // share of the largest amplitude
constexpr double kStandsOut = 0.01;  // m/s
constexpr std::size_t kApart = 10;   // frames, 0.1 s

// How far a maximum stands above the higher of the two lowest places that part it from a higher
// one.
double Prominence(std::span<const double> speed, std::size_t at) {
  double left = speed[at], right = speed[at];
  for (std::size_t k = at; k-- > 0 && speed[k] <= speed[at];) left = std::min(left, speed[k]);
  for (std::size_t k = at + 1; k < speed.size() && speed[k] <= speed[at]; ++k)
    right = std::min(right, speed[k]);
  return speed[at] - std::max(left, right);
}

}  // namespace

std::optional<double> SpectralArcLength(std::span<const double> speed) {
  if (speed.empty()) return std::nullopt;
  std::size_t size = 1;
  while (size < speed.size()) size *= 2;
  size *= 16;  // padded, so that the curve is smooth
  std::vector<double> padded(size, 0.0);
  std::copy(speed.begin(), speed.end(), padded.begin());
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> transform;
  transform.fwd(spectrum, padded);

  const double step = 1 / (kFrameTime * static_cast<double>(size));  // Hz
  std::vector<double> amplitude;
  for (std::size_t k = 0; k < size / 2 && step * static_cast<double>(k) <= kHighest; ++k)
    amplitude.push_back(std::abs(spectrum[k]));
  const double largest = *std::max_element(amplitude.begin(), amplitude.end());
  if (!(largest > 0)) return std::nullopt;
  for (double& a : amplitude) a /= largest;
  const auto is_strong = [](double a) { return a >= kFaint; };
  const auto first = std::find_if(amplitude.begin(), amplitude.end(), is_strong);
  const auto last = std::find_if(amplitude.rbegin(), amplitude.rend(), is_strong).base() - 1;
  if (last == first) return std::nullopt;
  const double pace = 1 / static_cast<double>(last - first);
  double length = 0;
  for (auto at = first; at != last; ++at) length += std::hypot(pace, at[1] - at[0]);
  return -length;
}

std::optional<double> LogDimensionlessJerk(std::span<const double> speed) {
  if (speed.size() < 3) return std::nullopt;
  const double largest = *std::max_element(speed.begin(), speed.end());
  const double duration = kFrameTime * static_cast<double>(speed.size() - 1);
  double sum = 0;
  for (std::size_t k = 1; k + 1 < speed.size(); ++k) {
    const double second = (speed[k + 1] - 2 * speed[k] + speed[k - 1]) / (kFrameTime * kFrameTime);
    sum += second * second * kFrameTime;
  }
  if (!(largest > 0) || !(sum > 0)) return std::nullopt;
  return -std::log(std::pow(duration, 3) / (largest * largest) * sum);
}

int MoveCount(std::span<const double> speed, double least) {
  std::vector<std::size_t> maxima;
  for (std::size_t k = 1; k + 1 < speed.size(); ++k)
    if (speed[k] >= least && speed[k] > speed[k - 1] && speed[k] >= speed[k + 1] &&
        Prominence(speed, k) >= kStandsOut)
      maxima.push_back(k);
  std::stable_sort(maxima.begin(), maxima.end(),
                   [&](std::size_t a, std::size_t b) { return speed[a] > speed[b]; });
  std::vector<std::size_t> kept;
  for (const std::size_t k : maxima)
    if (std::none_of(kept.begin(), kept.end(), [&](std::size_t other) {
          return std::max(k, other) - std::min(k, other) < kApart;
        }))
      kept.push_back(k);
  return static_cast<int>(kept.size());
}

}  // namespace arthro::simulation
