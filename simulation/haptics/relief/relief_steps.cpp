#include "simulation/haptics/relief/relief_steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "simulation/haptics/relief/plane_filters.h"

namespace arthro::simulation {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

// A line of at least the least height has parts of half of it.
constexpr float kLeastShare = 0.5f;

// Pixels by the side of a step that they lie on.
enum Mark : std::uint8_t {
  kOrdinary = 0,
  kHigh = 1,     // above the middle of the step
  kSteep = 2,    // near a step of half the least height
  kCertain = 4,  // near a step of the least height
};

// Lines of pixels beside links between the two sides of a step.
struct Lines {
  int width = 0, height = 0;
  std::vector<std::uint8_t> marks;

  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  bool IsStep(std::size_t a, std::size_t b, int mark) const {
    return ((marks[a] ^ marks[b]) & kHigh) != 0 && (marks[a] & marks[b] & mark) != 0;
  }
  bool IsBeside(int x, int y, int mark) const {
    const std::size_t i = At(x, y);
    return (x > 0 && IsStep(i, i - 1, mark)) || (x + 1 < width && IsStep(i, i + 1, mark)) ||
           (y > 0 && IsStep(i, At(x, y - 1), mark)) ||
           (y + 1 < height && IsStep(i, At(x, y + 1), mark));
  }
};

// Marks the pixels of the lines that are neither short nor mostly low, and returns the widest
// smoothing beside them, px; 0 where there is none.
float KeepLongLines(const Lines& lines, const FloatPlane& smoothing, const StepLimits& limits,
                    FloatPlane& kept) {
  std::vector<std::uint8_t> is_open(lines.marks.size(), 0);
  ForRowsOnTwoThreads(0, lines.height, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < lines.width; ++x)
        is_open[lines.At(x, y)] = lines.IsBeside(x, y, kSteep) ? 1 : 0;
  });
  float widest = 0.0f;
  std::vector<std::pair<int, int>> line;
  for (int top = 0; top < lines.height; ++top)
    for (int left = 0; left < lines.width; ++left) {
      if (!is_open[lines.At(left, top)]) continue;
      line.assign(1, {left, top});
      is_open[lines.At(left, top)] = 0;
      int right = left, first = left, bottom = top;
      std::size_t certain = 0;
      double width = 0;
      for (std::size_t next = 0; next < line.size(); ++next) {
        const auto [x, y] = line[next];
        first = std::min(first, x), right = std::max(right, x), bottom = std::max(bottom, y);
        certain += lines.IsBeside(x, y, kCertain) ? 1 : 0;
        width += static_cast<double>(smoothing[lines.At(x, y)]);
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, lines.height - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, lines.width - 1); ++u)
            if (is_open[lines.At(u, v)]) is_open[lines.At(u, v)] = 0, line.emplace_back(u, v);
      }
      const auto count = static_cast<double>(line.size());
      if (std::hypot(right - first + 1, bottom - top + 1) < limits.extent * width / count ||
          static_cast<double>(certain) < limits.certain_share * count)
        continue;
      for (const auto& [x, y] : line) {
        kept[lines.At(x, y)] = 1.0f;
        widest = std::max(widest, smoothing[lines.At(x, y)]);
      }
    }
  return widest;
}

}  // namespace

std::vector<float> NearSteps(int width, int height, const std::vector<float>& smooth,
                             const std::vector<float>& sigma, const std::vector<float>& smoothing,
                             const std::vector<float>& pixel_size, const StepLimits& limits) {
  // Highest and lowest relief within reach, and the least error: one certain side suffices.
  FloatPlane high(smooth.size()), low(smooth.size()), error(smooth.size());
  ForPixelsOnTwoThreads(smooth.size(), [&](std::size_t i) {
    const bool is_known = std::isfinite(smooth[i]);
    high[i] = is_known ? smooth[i] : -kNothing;
    low[i] = is_known ? -smooth[i] : -kNothing;
    error[i] = is_known ? -sigma[i] : -kNothing;
  });
  for (FloatPlane* const plane : {&high, &low, &error}) Dilate(*plane, width, height, limits.reach);

  Lines lines{width, height, std::vector<std::uint8_t>(smooth.size(), kOrdinary)};
  ForPixelsOnTwoThreads(smooth.size(), [&](std::size_t i) {
    if (!std::isfinite(smooth[i]) || !(smoothing[i] > 0.0f)) return;
    const auto least = static_cast<float>(
        std::max(-limits.errors * static_cast<double>(error[i]),
                 2.0 * limits.slope * limits.reach * static_cast<double>(pixel_size[i])));
    const float step = high[i] + low[i];
    if (step < kLeastShare * least) return;
    lines.marks[i] = static_cast<std::uint8_t>(
        kSteep | (smooth[i] > 0.5f * (high[i] - low[i]) ? kHigh : kOrdinary) |
        (step >= least ? kCertain : kOrdinary));
  });
  FloatPlane near(smooth.size(), 0.0f);
  const float widest = KeepLongLines(lines, smoothing, limits, near);
  if (!(widest > 0.0f)) return {};
  Dilate(near, width, height, limits.reach + static_cast<int>(std::ceil(2.0f * widest)));
  return near;
}

}  // namespace arthro::simulation
