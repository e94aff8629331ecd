#include "simulation/haptics/relief/plane_filters.h"

#include <algorithm>
#include <cstddef>
#include <thread>
#include <utility>

namespace arthro::simulation {
namespace {

// Returns the weights of `passes` passes of (1 2 1)/4, which is the binomial row 2·passes.
std::vector<float> BinomialKernel(int passes) {
  std::vector<double> kernel{1.0};
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<double> next(kernel.size() + 2, 0.0);
    for (std::size_t i = 0; i < kernel.size(); ++i) {
      next[i] += 0.25 * kernel[i];
      next[i + 1] += 0.5 * kernel[i];
      next[i + 2] += 0.25 * kernel[i];
    }
    kernel = std::move(next);
  }
  return {kernel.begin(), kernel.end()};
}

// Applies the separable filter, row by row. Pixels beyond the border have no mass.
void Filter(Plane& data, int width, int height, const std::vector<float>& kernel) {
  const int half = static_cast<int>(kernel.size()) / 2;
  const auto w = static_cast<std::size_t>(width);
  Plane padded(w + 2 * static_cast<std::size_t>(half), 0.0f);
  for (int y = 0; y < height; ++y) {
    float* row = data.data() + static_cast<std::size_t>(y) * w;
    std::copy(row, row + w, padded.begin() + half);
    std::fill(row, row + w, 0.0f);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (std::size_t x = 0; x < w; ++x) row[x] += kernel[k] * padded[x + k];
  }
  const Plane across = data;
  std::fill(data.begin(), data.end(), 0.0f);
  for (int y = 0; y < height; ++y) {
    float* row = data.data() + static_cast<std::size_t>(y) * w;
    for (int k = 0; k < static_cast<int>(kernel.size()); ++k) {
      const int from = y + k - half;
      if (from < 0 || from >= height) continue;
      const float* source = across.data() + static_cast<std::size_t>(from) * w;
      const float weight = kernel[static_cast<std::size_t>(k)];
      for (std::size_t x = 0; x < w; ++x) row[x] += weight * source[x];
    }
  }
}

}  // namespace

void FilterBinomial(Plane& data, int width, int height, int passes) {
  if (passes > 0) Filter(data, width, height, BinomialKernel(passes));
}

void Widen(Plane& data, int width, int height, int gap, const OuterTaps& taps, Plane& scratch) {
  const auto w = static_cast<std::size_t>(width), g = static_cast<std::size_t>(gap);
  scratch.assign(w + 2 * g, 0.0f);
  for (int y = 0; y < height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * w;
    float* row = data.data() + first;
    std::copy(row, row + w, scratch.begin() + gap);
    if (taps.left.empty()) {
      for (std::size_t x = 0; x < w; ++x)
        row[x] = 0.25f * (scratch[x] + scratch[x + 2 * g]) + 0.5f * scratch[x + g];
      continue;
    }
    const float *left = taps.left.data() + first, *right = taps.right.data() + first;
    for (std::size_t x = 0; x < w; ++x)
      row[x] = left[x] * scratch[x] + right[x] * scratch[x + 2 * g] + 0.5f * scratch[x + g];
  }
  scratch = data;
  for (int y = 0; y < height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * w;
    float* row = data.data() + first;
    for (std::size_t x = 0; x < w; ++x) row[x] *= 0.5f;
    for (const int from : {y - gap, y + gap}) {
      if (from < 0 || from >= height) continue;
      const float* source = scratch.data() + static_cast<std::size_t>(from) * w;
      if (taps.above.empty()) {
        for (std::size_t x = 0; x < w; ++x) row[x] += 0.25f * source[x];
        continue;
      }
      const float* tap = (from < y ? taps.above : taps.below).data() + first;
      for (std::size_t x = 0; x < w; ++x) row[x] += tap[x] * source[x];
    }
  }
}

void WidenAll(std::span<Plane* const> planes, int width, int height, int gap,
              const OuterTaps& taps) {
  const auto every_other = [&](std::size_t first) {
    Plane scratch;
    for (std::size_t i = first; i < planes.size(); i += 2)
      Widen(*planes[i], width, height, gap, taps, scratch);
  };
  const std::jthread other(every_other, std::size_t{1});
  every_other(0);
}

}  // namespace arthro::simulation
