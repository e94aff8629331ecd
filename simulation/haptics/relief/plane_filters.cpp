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
void Filter(FloatPlane& data, int width, int height, const std::vector<float>& kernel) {
  const int half = static_cast<int>(kernel.size()) / 2;
  const auto w = static_cast<std::size_t>(width);
  FloatPlane padded(w + 2 * static_cast<std::size_t>(half), 0.0f);
  for (int y = 0; y < height; ++y) {
    float* row = data.data() + static_cast<std::size_t>(y) * w;
    std::copy(row, row + w, padded.begin() + half);
    std::fill(row, row + w, 0.0f);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (std::size_t x = 0; x < w; ++x) row[x] += kernel[k] * padded[x + k];
  }
  const FloatPlane across = data;
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

void FilterBinomial(FloatPlane& data, int width, int height, int passes) {
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

// Down the columns: 1/2 of the own row, a share of the one above and one of the one below.
void WidenColumns(float* __restrict row, const float* __restrict above, const float* __restrict own,
                  const float* __restrict below, const float* __restrict tap_above,
                  const float* __restrict tap_below, std::size_t width) {
  if (tap_above == nullptr) {
    for (std::size_t x = 0; x < width; ++x)
      row[x] = (0.5f * own[x] + 0.25f * above[x]) + 0.25f * below[x];
    return;
  }
  for (std::size_t x = 0; x < width; ++x)
    row[x] = (0.5f * own[x] + tap_above[x] * above[x]) + tap_below[x] * below[x];
}

// Widens rows of a plane along themselves, within a window.
class Across {
 public:
  Across(int width, int gap, const OuterTaps& taps, const PixelBounds& window)
      : taps_(taps),
        stride_(static_cast<std::size_t>(width)),
        left_(static_cast<std::size_t>(window.left)),
        gap_(static_cast<std::size_t>(gap)),
        width_(static_cast<std::size_t>(window.width())),
        before_(std::min(left_, gap_)),
        after_(std::min(stride_ - static_cast<std::size_t>(window.right), gap_)),
        padded_(width_ + 2 * gap_, 0.0f),
        weights_(width_ + 2 * gap_, 0.25f) {}

  // Place of the window's part of row `y` in a plane.
  std::size_t Start(int y) const { return static_cast<std::size_t>(y) * stride_ + left_; }

  // Into a row of the window's width.
  void Row(const FloatPlane& data, int y, float* to) {
    const float* from = data.data() + Start(y) - before_;
    const float* of_row = taps_.right.empty() ? nullptr : taps_.right.data() + Start(y) - before_;
    if (before_ < gap_ || after_ < gap_) {  // at the border
      std::copy_n(from, before_ + width_ + after_, padded_.begin() + Signed(gap_ - before_));
      from = padded_.data();
      if (of_row != nullptr && before_ < gap_) {
        std::copy_n(of_row, before_ + width_, weights_.begin() + Signed(gap_ - before_));
        of_row = weights_.data();
      }
    }
    WidenRow(to, width_, gap_, from, of_row);
  }

 private:
  static std::ptrdiff_t Signed(std::size_t count) { return static_cast<std::ptrdiff_t>(count); }

  const OuterTaps& taps_;
  std::size_t stride_, left_, gap_, width_, before_, after_;
  FloatPlane padded_, weights_;
};

// Rows that a window of a plane reads.
struct ReadRows {
  int first, last;
};
ReadRows RowsReadBy(const PixelBounds& window, int gap, int height) {
  return {std::max(window.top - gap, 0), std::min(window.bottom + gap, height)};
}

// Row `y` of a window from rows that are widened along themselves. `taps`: from row to row; empty:
// 1/4. Weights of rows beyond the border do not count: their values are 0.
void WidenDown(FloatPlane& data, int y, int gap, const float* above, const float* own,
               const float* below, const OuterTaps& taps, const Across& across, int width) {
  const float* const tap_below = taps.below.empty() ? nullptr : taps.below.data() + across.Start(y);
  const float* const tap_above =
      taps.below.empty() || y < gap ? tap_below : taps.below.data() + across.Start(y - gap);
  WidenColumns(data.data() + across.Start(y), above, own, below, tap_above, tap_below,
               static_cast<std::size_t>(width));
}

}  // namespace

void Widen(FloatPlane& data, int width, int height, int gap, const OuterTaps& taps,
           const PixelBounds& window, FloatPlane& scratch) {
  // A row of zeros beyond the border; the rows from a gap above to a gap below this one, widened
  // along themselves.
  const auto w = static_cast<std::size_t>(window.width());
  const int held = 2 * gap + 1;
  if (const std::size_t size = w * (1 + static_cast<std::size_t>(held)); scratch.size() < size)
    scratch.resize(size);
  std::fill_n(scratch.begin(), w, 0.0f);
  Across across(width, gap, taps, window);
  const auto [first, last] = RowsReadBy(window, gap, height);
  const auto row_at = [&, first = first, last = last](int y) {
    const bool is_read = first <= y && y < last;
    return scratch.data() + (is_read ? w + static_cast<std::size_t>(y % held) * w : 0);
  };
  for (int y = first; y < window.top + gap; ++y)
    if (y < last) across.Row(data, y, row_at(y));
  for (int y = window.top; y < window.bottom; ++y) {
    if (y + gap < last) across.Row(data, y + gap, row_at(y + gap));
    WidenDown(data, y, gap, row_at(y - gap), row_at(y), row_at(y + gap), taps, across,
              window.width());
  }
}

void WidenOnTwoThreads(FloatPlane& data, int width, int height, int gap, const OuterTaps& taps,
                       const PixelBounds& window, FloatPlane& scratch) {
  if (scratch.size() < data.size()) scratch.resize(data.size());
  const auto [first, last] = RowsReadBy(window, gap, height);
  ForRowsOnTwoThreads(first, last, [&](int begin, int end) {
    Across across(width, gap, taps, window);
    for (int y = begin; y < end; ++y) across.Row(data, y, scratch.data() + across.Start(y));
  });
  const FloatPlane none(static_cast<std::size_t>(window.width()), 0.0f);
  ForRowsOnTwoThreads(
      window.top, window.bottom, [&, first = first, last = last](int begin, int end) {
        const Across across(width, gap, taps, window);
        const auto row_at = [&](int y) {
          return first <= y && y < last ? scratch.data() + across.Start(y) : none.data();
        };
        for (int y = begin; y < end; ++y)
          WidenDown(data, y, gap, row_at(y - gap), row_at(y), row_at(y + gap), taps, across,
                    window.width());
      });
}

void Dilate(FloatPlane& data, int width, int height, int reach) {
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
    FloatPlane padded(w + 2 * r), spare(w + 2 * r);
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
    FloatPlane tall((h + 2 * r) * kStrip);
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

void WidenAll(std::span<FloatPlane* const> planes, int width, int height, int gap,
              const OuterTaps& taps, const PixelBounds& window) {
  const auto every_other = [&](std::size_t first) {
    FloatPlane scratch;
    for (std::size_t i = first; i < planes.size(); i += 2)
      Widen(*planes[i], width, height, gap, taps, window, scratch);
  };
  const std::jthread other(every_other, std::size_t{1});
  every_other(0);
}

}  // namespace arthro::simulation
