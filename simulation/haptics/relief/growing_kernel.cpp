#include "simulation/haptics/relief/growing_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace arthro::simulation {
namespace {

// Smallest rectangle around the pixels of `within` of which `asks(i)` is true. `may(y)`: a row that
// may have some.
template <class May, class Asks>
PixelBounds BoundsOf(const PixelBounds& within, int width, const May& may, const Asks& asks) {
  PixelBounds bounds;
  for (int y = within.top; y < within.bottom; ++y) {
    if (!may(static_cast<std::size_t>(y))) continue;
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    int first = within.left, last = within.right;
    while (first < last && !asks(row + static_cast<std::size_t>(first))) ++first;
    if (first == last) continue;
    while (!asks(row + static_cast<std::size_t>(last - 1))) --last;
    bounds = Joined(bounds, {first, y, last, y + 1});
  }
  return bounds;
}

// Largest smoothing in each row.
std::vector<float> WidestOfRows(const FloatPlane& deviation, int width, int height) {
  std::vector<float> widest(static_cast<std::size_t>(height));
  ForRowsOnTwoThreads(0, height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const auto row = deviation.begin() + static_cast<std::ptrdiff_t>(y) * width;
      widest[static_cast<std::size_t>(y)] = *std::max_element(row, row + width);
    }
  });
  return widest;
}

// Smallest rectangle around the blocks that a kernel of that reach is uneven in, within `window`.
PixelBounds UnevenIn(const PixelBounds& window, const EvenBlocks& blocks, int reach) {
  constexpr int kSide = EvenBlocks::kSide;
  PixelBounds uneven;
  if (window.is_empty()) return uneven;
  for (int row = window.top / kSide; row * kSide < window.bottom; ++row)
    for (int column = window.left / kSide; column * kSide < window.right; ++column)
      if (blocks.distance[static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks.columns) +
                          static_cast<std::size_t>(column)] <= reach)
        uneven = Joined(uneven,
                        {std::max(column * kSide, window.left), std::max(row * kSide, window.top),
                         std::min((column + 1) * kSide, window.right),
                         std::min((row + 1) * kSide, window.bottom)});
  return uneven;
}

// Joined with what the next growth reads.
void AddReadBy(const PixelBounds& next, int gap, int width, int height, PixelBounds& box) {
  if (!next.is_empty()) box = Joined(box, Grown(next, gap, width, height));
}

}  // namespace

std::vector<int> GapsOf(double deviation_px) {
  std::vector<int> gaps;
  double variance = 0;
  for (int growth = 0; variance < deviation_px * deviation_px; ++growth) {
    gaps.push_back(1 << (growth / 2));
    variance += 0.5 * gaps.back() * gaps.back();
  }
  return gaps;
}

int ReachOf(double deviation_px) {
  const std::vector<int> gaps = GapsOf(deviation_px);
  return std::accumulate(gaps.begin(), gaps.end(), 0);
}

EvenBlocks EvenBlocksOf(const DepthMap& depth, const FloatPlane& near) {
  constexpr int kSide = EvenBlocks::kSide;
  const int w = depth.width, h = depth.height;
  EvenBlocks blocks{(w + kSide - 1) / kSide, (h + kSide - 1) / kSide, {}};
  // Distances in blocks, with a border of uneven ones about the map.
  const auto stride = static_cast<std::size_t>(blocks.columns) + 2;
  std::vector<int> framed(stride * (static_cast<std::size_t>(blocks.rows) + 2), 0);
  const auto row_of = [&](int row) {
    return framed.data() + static_cast<std::size_t>(row + 1) * stride + 1;
  };
  ForRowsOnTwoThreads(0, blocks.rows, [&](int first, int last) {
    for (int row = first; row < last; ++row)
      for (int column = 0; column < blocks.columns; ++column) {
        const int left = column * kSide, top = row * kSide;
        // A block that the border cuts off is uneven.
        bool is_even = left + kSide <= w && top + kSide <= h;
        for (int y = top; is_even && y < top + kSide; ++y) {
          const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                    static_cast<std::size_t>(left);
          for (std::size_t i = begin; i < begin + kSide; ++i)
            is_even &= std::isfinite(depth.relief[i]) && (near.empty() || !(near[i] > 0.0f));
        }
        row_of(row)[column] = is_even ? blocks.columns + blocks.rows : 0;
      }
  });
  // Down and right, then up and left: three blocks of the row before, and the one beside.
  for (const int step : {1, -1})
    for (int i = 0; i < blocks.rows; ++i) {
      const int y = step > 0 ? i : blocks.rows - 1 - i;
      int* const row = row_of(y);
      const int* const before = row_of(y - step);
      for (int j = 0; j < blocks.columns; ++j) {
        const int x = step > 0 ? j : blocks.columns - 1 - j;
        row[x] = std::min(row[x],
                          1 + std::min({before[x - 1], before[x], before[x + 1], row[x - step]}));
      }
    }
  for (int y = 0; y < blocks.rows; ++y)
    for (int x = 0; x < blocks.columns; ++x)
      blocks.distance.push_back(std::max(0, (row_of(y)[x] - 1) * kSide + 1));
  return blocks;
}

std::vector<Growth> GrowthsOf(const PixelBounds& wanted, const FloatPlane& deviation,
                              const EvenBlocks& blocks, int passes, const std::vector<int>& gaps,
                              int width, int height) {
  const std::vector<float> widest = WidestOfRows(deviation, width, height);
  const auto asks = [](float of_pixel, float variance) {
    return of_pixel * of_pixel - variance > 0.0f;
  };
  std::vector<Growth> growths;
  float variance = 0.0f;
  for (int reach = passes; const int gap : gaps) {
    reach += gap;
    growths.push_back({gap, reach, variance, {}, {}});
    growths.back().window = BoundsOf(
        wanted, width, [&](std::size_t row) { return asks(widest[row], variance); },
        [&](std::size_t i) { return asks(deviation[i], variance); });
    variance += AddedVariance(gap);
  }
  while (!growths.empty() && growths.back().window.is_empty()) growths.pop_back();
  for (std::size_t i = growths.size(); i-- > 0;) {
    Growth& growth = growths[i];
    const Growth* const next = i + 1 < growths.size() ? &growths[i + 1] : nullptr;
    if (next != nullptr) AddReadBy(next->window, next->gap, width, height, growth.window);
    growth.uneven = UnevenIn(growth.window, blocks, growth.reach);
    if (next != nullptr) AddReadBy(next->uneven, next->gap, width, height, growth.uneven);
  }
  return growths;
}

}  // namespace arthro::simulation
