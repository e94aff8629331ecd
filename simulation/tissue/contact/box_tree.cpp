#include "simulation/tissue/contact/box_tree.h"

#include <algorithm>
#include <numeric>

namespace arthro::simulation {
namespace {

constexpr int kLeafSize = 4;  // below four items a further box costs more than it saves

glm::dvec3 Centre(const Box3& box) { return box.low + box.high; }  // twice; only compared

}  // namespace

BoxTree::BoxTree(std::span<const Box3> boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size());
  Build(boxes, 0, static_cast<int>(boxes.size()));
  Refit([&](int i) noexcept { return boxes[static_cast<std::size_t>(i)]; });
}

void BoxTree::Build(std::span<const Box3> boxes, int first, int count) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  if (count <= kLeafSize) {
    nodes_[node].next = first;
    nodes_[node].count = count;
    return;
  }
  // Halved along the axis in which the items spread most; equal centres go by index.
  const auto begin = items_.begin() + first, end = begin + count;
  const auto centre = [&](int i) { return Centre(boxes[static_cast<std::size_t>(i)]); };
  glm::dvec3 low = centre(*begin), high = low;
  for (auto i = begin; i != end; ++i) {
    low = glm::min(low, centre(*i));
    high = glm::max(high, centre(*i));
  }
  const glm::dvec3 spread = high - low;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const int half = count / 2;
  std::nth_element(begin, begin + half, end, [&](int a, int b) {
    const double x = centre(a)[axis], y = centre(b)[axis];
    return x < y || (x == y && a < b);
  });
  Build(boxes, first, half);
  nodes_[node].next = static_cast<std::int32_t>(nodes_.size());
  Build(boxes, first + half, count - half);
}

}  // namespace arthro::simulation
