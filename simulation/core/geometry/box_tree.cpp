#include "simulation/core/geometry/box_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace arthro {
namespace {

constexpr int kLeafSize = 12;  // with fewer items another box costs more than it saves
constexpr int kBits = 10;      // per axis of a position

glm::dvec3 Centre(const Box3& box) {
  return box.low + box.high;
}  // twice the centre; only compared

struct Placed {
  std::uint32_t code;  // Morton code: interleaved bits of x, y and z
  int item;
};

// Sorts the items along a Morton curve, items of one cell by index. A radix sort is used because a
// cut rebuilds a tree of about 33,000 triangles within a frame. Splitting at medians took seven
// times as long and gave queries of the same speed on a crescent's skin.
std::vector<Placed> SortAlongCurve(std::span<const Box3> boxes) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Box3& box : boxes) {
    low = glm::min(low, Centre(box));
    high = glm::max(high, Centre(box));
  }
  constexpr int kCells = 1 << kBits;
  const glm::dvec3 size = high - low;
  const double longest = std::max({size.x, size.y, size.z});
  const double scale = longest > 0.0 && std::isfinite(longest) ? kCells / longest : 0.0;
  const auto spread = [](std::uint32_t v) {  // inserts two zeros after each bit
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
  };
  std::vector<Placed> sorted(boxes.size()), other(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const glm::dvec3 at = scale * (Centre(boxes[i]) - low);
    const auto cell = [](double x) {  // this order of min and max turns NaN into 0
      return static_cast<std::uint32_t>(std::min(std::max(0.0, x), kCells - 1.0));
    };
    sorted[i] = {spread(cell(at.x)) << 2 | spread(cell(at.y)) << 1 | spread(cell(at.z)),
                 static_cast<int>(i)};
  }
  for (int shift = 0; shift < 3 * kBits; shift += kBits) {
    const auto digit = [shift](const Placed& p) { return p.code >> shift & (kCells - 1); };
    std::array<int, kCells + 1> begin{};
    for (const Placed& p : sorted) ++begin[digit(p) + 1];
    for (std::size_t d = 0; d < kCells; ++d) begin[d + 1] += begin[d];
    for (const Placed& p : sorted) other[static_cast<std::size_t>(begin[digit(p)]++)] = p;
    std::swap(sorted, other);
  }
  return sorted;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box3> boxes) : items_(boxes.size()) {
  if (boxes.empty()) return;
  std::vector<std::uint32_t> code(boxes.size());
  const std::vector<Placed> along = SortAlongCurve(boxes);
  for (std::size_t i = 0; i < along.size(); ++i) {
    items_[i] = along[i].item;
    code[i] = along[i].code;
  }
  nodes_.reserve(boxes.size());
  Build(code, 0, static_cast<int>(boxes.size()));
  Refit([&](int i) noexcept { return boxes[static_cast<std::size_t>(i)]; });
}

void BoxTree::Build(std::span<const std::uint32_t> code, int first, int count) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  if (count <= kLeafSize) {
    nodes_[node].next = first;
    nodes_[node].count = count;
    leaf_.push_back(static_cast<int>(node));
    return;
  }
  // Splits where the highest differing bit changes, which is a plane; items of one cell are halved.
  const auto begin = code.begin() + first, end = begin + count;
  const std::uint32_t differing = *begin ^ *(end - 1);
  int below = count / 2;
  if (differing != 0) {
    const std::uint32_t bit = std::bit_floor(differing);
    below = static_cast<int>(
        std::partition_point(begin, end, [bit](std::uint32_t c) { return (c & bit) == 0; }) -
        begin);
  }
  Build(code, first, below);
  nodes_[node].next = static_cast<std::int32_t>(nodes_.size());
  Build(code, first + below, count - below);
}

}  // namespace arthro
