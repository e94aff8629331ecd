#include "simulation/haptics/relief/plane_filters.h"

#include <algorithm>
#include <cstddef>
#include <limits>
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

namespace {

// One row: `padded` is the row with `gap` pixels more on either side, `taps` the weights between
// its pixels from the first padded one on; null: 1/4.
void WidenRow(float* __restrict row, std::size_t width, std::size_t gap,
              const float* __restrict padded, const float* __restrict taps) {
  const float *left = padded, *middle = padded + gap, *right = padded + 2 * gap;
  if (taps == nullptr) {
    for (std::size_t x = 0; x < width; ++x)
      row[x] = 0.25f * (left[x] + right[x]) + 0.5f * middle[x];
    return;
  }
  const float* tap_right = taps + gap;
  for (std::size_t x = 0; x < width; ++x)
    row[x] = taps[x] * left[x] + tap_right[x] * right[x] + 0.5f * middle[x];
}

// Down the columns: `row` becomes 1/2 of itself, a share of `above`, which it replaces, and a share
// of `below`.
void WidenColumns(float* __restrict row, float* __restrict above, const float* __restrict below,
                  const float* __restrict tap_above, const float* __restrict tap_below,
                  std::size_t width) {
  if (tap_above == nullptr) {
    for (std::size_t x = 0; x < width; ++x) {
      const float own = row[x];
      row[x] = (0.5f * own + 0.25f * above[x]) + 0.25f * below[x];
      above[x] = own;
    }
    return;
  }
  for (std::size_t x = 0; x < width; ++x) {
    const float own = row[x];
    row[x] = (0.5f * own + tap_above[x] * above[x]) + tap_below[x] * below[x];
    above[x] = own;
  }
}

}  // namespace

void Widen(Plane& data, int width, int height, int gap, const OuterTaps& taps,
           const PixelBounds& window, Plane& scratch) {
  const auto stride = static_cast<std::size_t>(width), g = static_cast<std::size_t>(gap);
  const auto w = static_cast<std::size_t>(window.width()),
             left = static_cast<std::size_t>(window.left);
  const bool has_taps = !taps.right.empty();
  // A padded row and the weights between its pixels, where it begins at the border; a row of zeros
  // beyond the border; the last `gap` rows as they were before this went down the columns.
  scratch.assign(2 * (w + 2 * g) + w + g * w, 0.0f);
  float *const padded = scratch.data(), *const weights = padded + w + 2 * g,
               *const none = weights + w + 2 * g, *const ring = none + w;
  std::fill(weights, none, 0.25f);
  const std::size_t before = std::min(left, g),
                    after = std::min(stride - static_cast<std::size_t>(window.right), g);
  const auto start = [&](int y) { return static_cast<std::size_t>(y) * stride + left; };
  const auto across = [&](int y) {
    float* const row = data.data() + start(y);
    std::copy(row - before, row + w + after, padded + g - before);
    const float* of_row = has_taps ? taps.right.data() + start(y) - before : nullptr;
    if (has_taps && before < g) {
      std::copy_n(of_row, w + before, weights + g - before);
      of_row = weights;
    }
    WidenRow(row, w, g, padded, of_row);
  };
  const int first = std::max(window.top - gap, 0), last = std::min(window.bottom + gap, height);
  for (int y = first; y < std::min(first + gap, last); ++y) across(y);
  for (int y = first; y < last; ++y) {
    if (y + gap < last) across(y + gap);
    // Weights of rows beyond the border do not count: their values are 0.
    const float* const tap_below = has_taps ? taps.below.data() + start(y) : nullptr;
    const float* const tap_above =
        has_taps && y >= gap ? taps.below.data() + start(y - gap) : tap_below;
    WidenColumns(data.data() + start(y), ring + static_cast<std::size_t>(y % gap) * w,
                 y + gap < last ? data.data() + start(y + gap) : none, tap_above, tap_below, w);
  }
}

void Dilate(Plane& data, int width, int height, int reach) {
  const auto w = static_cast<std::size_t>(width), r = static_cast<std::size_t>(reach),
             h = static_cast<std::size_t>(height);
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  // A window is doubled in length until a further doubling would exceed it; two of that length
  // cover it.
  std::size_t longest = 1;
  while (2 * longest <= 2 * r + 1) longest *= 2;
  const auto put_most = [](float* __restrict into, const float* __restrict from,
                           std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) into[i] = into[i] < from[i] ? from[i] : into[i];
  };
  ForRowsOnTwoThreads(0, height, [&](int first, int last) {
    Plane padded(w + 2 * r), spare(w + 2 * r);
    for (int y = first; y < last; ++y) {
      float* const row = data.data() + static_cast<std::size_t>(y) * w;
      std::fill(padded.begin(), padded.end(), -kNothing);
      std::copy(row, row + w, padded.begin() + static_cast<std::ptrdiff_t>(r));
      for (std::size_t length = 1; length < longest; length *= 2) {
        spare = padded;
        put_most(padded.data(), spare.data() + length, padded.size() - length);
      }
      std::copy_n(padded.data(), w, row);
      put_most(row, padded.data() + 2 * r + 1 - longest, w);
    }
  });
  // The same down the columns, with rows beyond the border left out, in strips that fit a cache.
  constexpr std::size_t kStrip = 128;  // px
  ForRowsOnTwoThreads(0, static_cast<int>((w + kStrip - 1) / kStrip), [&](int first, int last) {
    Plane tall((h + 2 * r) * kStrip);
    for (int strip = first; strip < last; ++strip) {
      const std::size_t left = static_cast<std::size_t>(strip) * kStrip,
                        count = std::min(kStrip, w - left);
      const auto at = [&](std::size_t y) { return tall.data() + y * count; };
      std::fill(tall.begin(), tall.end(), -kNothing);
      for (std::size_t y = 0; y < h; ++y) std::copy_n(data.data() + y * w + left, count, at(r + y));
      for (std::size_t length = 1; length < longest; length *= 2)
        for (std::size_t y = 0; y + length < h + 2 * r; ++y) put_most(at(y), at(y + length), count);
      for (std::size_t y = 0; y < h; ++y) {
        float* const row = data.data() + y * w + left;
        std::copy_n(at(y), count, row);
        put_most(row, at(y + 2 * r + 1 - longest), count);
      }
    }
  });
}

void ForRowsOnTwoThreads(int begin, int end, const std::function<void(int, int)>& rows) {
  const int half = begin + (end - begin) / 2;
  const std::jthread other([&] { rows(half, end); });
  rows(begin, half);
}

void WidenAll(std::span<Plane* const> planes, int width, int height, int gap, const OuterTaps& taps,
              const PixelBounds& window) {
  const auto every_other = [&](std::size_t first) {
    Plane scratch;
    for (std::size_t i = first; i < planes.size(); i += 2)
      Widen(*planes[i], width, height, gap, taps, window, scratch);
  };
  const std::jthread other(every_other, std::size_t{1});
  every_other(0);
}

}  // namespace arthro::simulation
