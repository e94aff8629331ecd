// Tree of boxes over items that move but stay neighbours: built once from the rest state and
// refitted when the items have moved. m. Refit and Visit are noexcept and allocate nothing. The
// order of visits depends on the boxes only.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/geometry/box3.h"

namespace arthro {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Box3> boxes);

  bool empty() const noexcept { return nodes_.empty(); }
  // Box of all items; undefined for an empty tree.
  const Box3& box() const noexcept { return nodes_.front().box; }

  // Leaves in item order, for callers that compute shared data once per leaf.
  int leaf_count() const noexcept { return static_cast<int>(leaf_.size()); }
  std::span<const int> LeafItems(int leaf) const noexcept {
    const Node& node = nodes_[static_cast<std::size_t>(leaf_[static_cast<std::size_t>(leaf)])];
    return {items_.data() + node.next, static_cast<std::size_t>(node.count)};
  }

  // `box_of(leaf)` returns the present box of all items of the leaf.
  template <class BoxOf>
  void RefitLeaves(BoxOf&& box_of) noexcept {
    int leaf = leaf_count();
    for (std::size_t n = nodes_.size(); n-- > 0;) {
      Node& node = nodes_[n];
      if (node.count == 0) {
        const Box3 &a = nodes_[n + 1].box, &b = nodes_[static_cast<std::size_t>(node.next)].box;
        node.box = {glm::min(a.low, b.low), glm::max(a.high, b.high)};
      } else {
        node.box = box_of(--leaf);
      }
    }
  }

  // `box_of(i)` returns the present box of item i.
  template <class BoxOf>
  void Refit(BoxOf&& box_of) noexcept {
    RefitLeaves([&](int leaf) noexcept {
      Box3 box{glm::dvec3(std::numeric_limits<double>::max()),
               glm::dvec3(std::numeric_limits<double>::lowest())};
      for (const int i : LeafItems(leaf)) {
        const Box3 item = box_of(i);
        box = {glm::min(box.low, item.low), glm::max(box.high, item.high)};
      }
      return box;
    });
  }

  // Calls visit(i) for the items of each leaf whose box is within the square root of `limit2` of
  // `shape` (a point or a box). Visits nearer boxes first. `visit` may lower limit2; a value below
  // zero ends the search.
  template <class Shape, class Visit>
  void ForNear(const Shape& shape, double& limit2, Visit&& visit) const noexcept {
    if (nodes_.empty()) return;
    struct Entry {
      std::int32_t node;
      double distance2;
    };
    std::array<Entry, kDeepest> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, Distance2(nodes_.front().box, shape)};
    while (depth > 0 && limit2 >= 0.0) {
      const Entry entry = stack[--depth];
      if (!(entry.distance2 <= limit2)) continue;
      const Node& node = nodes_[static_cast<std::size_t>(entry.node)];
      if (node.count > 0) {
        for (int i = node.next; i < node.next + node.count && limit2 >= 0.0; ++i)
          visit(items_[static_cast<std::size_t>(i)]);
        continue;
      }
      const auto child = [&](std::int32_t index) noexcept {
        return Entry{index, Distance2(nodes_[static_cast<std::size_t>(index)].box, shape)};
      };
      const Entry first = child(entry.node + 1), second = child(node.next);
      const bool is_second_nearer = second.distance2 < first.distance2;
      stack[depth++] = is_second_nearer ? first : second;
      stack[depth++] = is_second_nearer ? second : first;
    }
  }

 private:
  // A path splits by the 30 bits of a Morton code and then by halves, for 2^31 items at most. Each
  // level adds one entry.
  static constexpr std::size_t kDeepest = 64;
  // The children of an inner node are node + 1 and `next`; a leaf has count > 0 items from `next`.
  struct Node {
    Box3 box;
    std::int32_t next = 0, count = 0;
  };
  void Build(std::span<const std::uint32_t> code, int first, int count);

  std::vector<Node> nodes_;
  std::vector<int> items_, leaf_;  // leaf_: indices of the leaf nodes, rising
};

}  // namespace arthro
