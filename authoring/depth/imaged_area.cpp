#include "authoring/depth/imaged_area.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace arthro::authoring {
namespace {

// Sets of touching runs, by union-find with path halving. The lowest index represents a set, so the
// result does not depend on the order of joining.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t Find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) {
    a = Find(a);
    b = Find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

bool IsBlack(const std::uint8_t* row_flags, const Run& run) {
  return std::all_of(row_flags + run.first, row_flags + run.last,
                     [](std::uint8_t flag) { return (flag & kBlack) != 0; });
}

}  // namespace

RowRuns RunsOf(const std::vector<std::uint8_t>& flags, int width, int height, PixelFlag flag) {
  RowRuns runs(static_cast<std::size_t>(height));
  ForStripsOfRows(height, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const std::uint8_t* row = &flags[static_cast<std::size_t>(y) * width];
      for (int x = 0; x < width; ++x) {
        if (!(row[x] & flag)) continue;
        const int start = x;
        while (x < width && (row[x] & flag)) ++x;
        runs[y].push_back({start, x});
      }
    }
  });
  return runs;
}

RowRuns SurroundOf(const RowRuns& dark, const std::vector<std::uint8_t>& flags, int width,
                   int height) {
  constexpr std::size_t kLeastHole = 64;  // px; gaps of a mosaic are larger, dead pixels smaller
  std::vector<std::size_t> start(static_cast<std::size_t>(height) + 1);
  for (int y = 0; y < height; ++y) start[y + 1] = start[y] + dark[y].size();

  // Joins each run with those that overlap it in the row above.
  Components components(start[height]);
  for (int y = 1; y < height; ++y) {
    std::size_t above = 0;
    for (std::size_t i = 0; i < dark[y].size(); ++i) {
      const Run& run = dark[y][i];
      while (above < dark[y - 1].size() && dark[y - 1][above].last <= run.first) ++above;
      for (std::size_t j = above; j < dark[y - 1].size() && dark[y - 1][j].first < run.last; ++j)
        components.Join(start[y] + i, start[y - 1] + j);
    }
  }

  // Properties of a component: whether it touches the edge, its size, whether it is all black.
  struct Kind {
    bool is_at_edge = false, is_black = true;
    std::size_t area = 0;
  };
  std::vector<Kind> kinds(start[height]);
  for (int y = 0; y < height; ++y)
    for (std::size_t i = 0; i < dark[y].size(); ++i) {
      const Run& run = dark[y][i];
      Kind& kind = kinds[components.Find(start[y] + i)];
      kind.is_at_edge |= y == 0 || y == height - 1 || run.first == 0 || run.last == width;
      kind.area += static_cast<std::size_t>(run.last - run.first);
      kind.is_black = kind.is_black && IsBlack(&flags[static_cast<std::size_t>(y) * width], run);
    }

  RowRuns surround(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (std::size_t i = 0; i < dark[y].size(); ++i) {
      const Kind& kind = kinds[components.Find(start[y] + i)];
      if (kind.is_at_edge || (kind.is_black && kind.area >= kLeastHole))
        surround[y].push_back(dark[y][i]);
    }
  return surround;
}

std::vector<std::uint8_t> Grow(const RowRuns& runs, int width, int height, int margin) {
  std::vector<std::uint8_t> grown(static_cast<std::size_t>(width) * height, 0);
  const auto mark = [&](int y, const Run& run) {
    const int first = std::max(0, run.first - margin), last = std::min(width, run.last + margin);
    std::memset(&grown[static_cast<std::size_t>(y) * width + first], 1,
                static_cast<std::size_t>(last - first));
  };
  // Each row takes the runs of the rows around it; long runs make this a few memsets.
  ForStripsOfRows(height, [&](int strip_first, int strip_last) {
    for (int y = strip_first; y < strip_last; ++y)
      for (int other = std::max(0, y - margin); other <= std::min(height - 1, y + margin); ++other)
        for (const Run& run : runs[other]) mark(y, run);
  });
  return grown;
}

}  // namespace arthro::authoring
