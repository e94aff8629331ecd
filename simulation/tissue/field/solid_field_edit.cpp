// Boolean edits of a field and the record of their changes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

SolidField::NodeBox SolidField::NodesIn(const Box3& box) const {
  NodeBox nodes;
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const double last = grid_.count[i] - 1;
    const double low = std::ceil((box.low[a] - grid_.origin[a]) / grid_.spacing);
    const double high = std::floor((box.high[a] - grid_.origin[a]) / grid_.spacing);
    // Clamps a box that is not finite in a direction; NaN makes it empty.
    nodes.low[i] = low <= last ? static_cast<int>(std::max(0.0, low)) : grid_.count[i];
    nodes.high[i] = high >= 0.0 ? static_cast<int>(std::min(last, high)) : -1;
  }
  return nodes;
}

// Returns whether the surface crosses any cell around node (i, j, k).
bool SolidField::IsAtSurface(int i, int j, int k) const {
  const bool is_solid = value_[grid_.Index(i, j, k)] < 0;
  const auto& n = grid_.count;
  for (int c = std::max(0, k - 1); c <= std::min(n[2] - 1, k + 1); ++c)
    for (int b = std::max(0, j - 1); b <= std::min(n[1] - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(n[0] - 1, i + 1); ++a)
        if ((value_[grid_.Index(a, b, c)] < 0) != is_solid) return true;
  return false;
}

// Applies `change(i, j, k, value, cut)` to each node. A brick has changed if a node of its cells
// changed sides, or if a node of a cell that the surface crosses changed its value. The volume of
// such bricks is summed again.
template <class Change>
FieldEdit SolidField::Edit(const NodeBox& nodes, const Change& change) {
  FieldEdit edit;
  for (std::size_t a = 0; a < 3; ++a)
    if (nodes.low[a] > nodes.high[a]) return edit;
  if (cut_.empty()) cut_.assign(value_.size(), static_cast<float>(-band()));
  NodeBox near{grid_.count, {-1, -1, -1}};  // region in which the surface or the cut may have moved
  bool has_changed = false;
  // A value deeper than two cell diagonals affects no cell of the surface.
  const float deep = static_cast<float>(-2.0 * std::sqrt(3.0) * grid_.spacing);
  for (int k = nodes.low[2]; k <= nodes.high[2]; ++k)
    for (int j = nodes.low[1]; j <= nodes.high[1]; ++j)
      for (int i = nodes.low[0]; i <= nodes.high[0]; ++i) {
        const std::size_t node = grid_.Index(i, j, k);
        float &value = value_[node], &cut = cut_[node];
        const float old_value = value, old_cut = cut;
        change(i, j, k, value, cut);
        if (value == old_value && cut == old_cut) continue;
        if (std::max({value, old_value, cut, old_cut}) < deep) continue;
        near.low = {std::min(near.low[0], i), std::min(near.low[1], j), std::min(near.low[2], k)};
        near.high = {std::max(near.high[0], i), std::max(near.high[1], j),
                     std::max(near.high[2], k)};
        const bool has_turned = (value < 0) != (old_value < 0);
        has_changed |= has_turned || (cut > 0) != (old_cut > 0);
        if (!has_turned && (value == old_value || !IsAtSurface(i, j, k))) continue;
        has_changed = true;
        const auto brick = [&](int n, std::size_t a) {
          return std::clamp(n, 0, grid_.count[a] - 2) / kBrick;
        };
        for (int bk = brick(k - 1, 2); bk <= brick(k, 2); ++bk)
          for (int bj = brick(j - 1, 1); bj <= brick(j, 1); ++bj)
            for (int bi = brick(i - 1, 0); bi <= brick(i, 0); ++bi)
              brick_version_[BrickIndex(bi, bj, bk)] = version_ + 1;
      }
  if (!has_changed) return edit;
  ++version_;
  std::int64_t removed = 0;
  std::array<int, 3> first, last;
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = std::max(0, near.low[a] - 1) / kBrick;
    last[a] = std::min(near.high[a] / kBrick, bricks_[a] - 1);
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const std::size_t brick = BrickIndex(i, j, k);
        if (brick_version_[brick] != version_) continue;
        const std::int64_t before = brick_volume_[brick];
        brick_volume_[brick] = BrickVolume(i, j, k);
        removed += before - brick_volume_[brick];
      }
  volume_ -= removed;
  edit.removed = VolumeOf(removed);
  const glm::dvec3 cell(grid_.spacing);
  edit.changed = {grid_.Place(near.low[0], near.low[1], near.low[2]) - cell,
                  grid_.Place(near.high[0], near.high[1], near.high[2]) + cell};
  return edit;
}

FieldEdit SolidField::Subtract(const Box3& box,
                               const std::function<double(const glm::dvec3&)>& distance) {
  if (value_.empty()) return {};
  const double band_now = band();
  return Edit(NodesIn(box), [&](int i, int j, int k, float& value, float& cut) {
    const double d = distance(grid_.Place(i, j, k));
    if (!std::isfinite(d)) return;  // the tool has no finite position
    const float taken = static_cast<float>(std::clamp(-d, -band_now, band_now));
    value = std::max(value, taken);
    cut = std::max(cut, taken);
  });
}

FieldEdit SolidField::Add(const Box3& box,
                          const std::function<double(const glm::dvec3&)>& distance) {
  if (value_.empty()) return {};
  const double band_now = band();
  NodeBox nodes = NodesIn(box);
  for (std::size_t a = 0; a < 3; ++a) {  // the outermost nodes stay empty
    nodes.low[a] = std::max(nodes.low[a], 1);
    nodes.high[a] = std::min(nodes.high[a], grid_.count[a] - 2);
  }
  return Edit(nodes, [&](int i, int j, int k, float& value, float& cut) {
    const double d = distance(grid_.Place(i, j, k));
    if (!std::isfinite(d)) return;
    const float put = static_cast<float>(std::clamp(d, -band_now, band_now));
    value = std::min(value, put);
    cut = std::min(cut, put);
  });
}

FieldEdit SolidField::Erode(const Box3& box,
                            const std::function<double(const glm::dvec3&)>& distance,
                            double volume) {
  if (value_.empty() || !(volume > 0.0)) return {};
  const NodeBox nodes = NodesIn(box);
  for (std::size_t a = 0; a < 3; ++a)
    if (nodes.low[a] > nodes.high[a]) return {};
  const auto length = [&](std::size_t a) {
    return static_cast<std::size_t>(nodes.high[a] - nodes.low[a]) + 1;
  };
  const auto local = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(k - nodes.low[2]) * length(1) +
            static_cast<std::size_t>(j - nodes.low[1])) *
               length(0) +
           static_cast<std::size_t>(i - nodes.low[0]);
  };
  std::vector<double> tool(length(0) * length(1) * length(2));
  for (int k = nodes.low[2]; k <= nodes.high[2]; ++k)
    for (int j = nodes.low[1]; j <= nodes.high[1]; ++j)
      for (int i = nodes.low[0]; i <= nodes.high[0]; ++i)
        tool[local(i, j, k)] = distance(grid_.Place(i, j, k));
  // Estimates the area of the surface inside the tool. A surface of unit normal n crosses |n_a|/h²
  // grid edges along axis a per unit of area, so |n_a| h², summed over all crossings, is the area.
  double area = 0.0;
  for (int k = nodes.low[2]; k <= nodes.high[2]; ++k)
    for (int j = nodes.low[1]; j <= nodes.high[1]; ++j)
      for (int i = nodes.low[0]; i <= nodes.high[0]; ++i)
        for (int a = 0; a < 3; ++a) {
          std::array<int, 3> end{i, j, k};
          const auto axis = static_cast<std::size_t>(a);
          if (++end[axis] > nodes.high[axis]) continue;
          const double here = static_cast<double>(value_[grid_.Index(i, j, k)]),
                       there = static_cast<double>(value_[grid_.Index(end[0], end[1], end[2])]);
          if ((here < 0) == (there < 0)) continue;
          const double t = here / (here - there), in_tool = tool[local(i, j, k)];
          if (!(in_tool + t * (tool[local(end[0], end[1], end[2])] - in_tool) < 0)) continue;
          glm::dvec3 crossing = grid_.Place(i, j, k);
          crossing[a] += t * grid_.spacing;
          const glm::dvec3 slope = Gradient(crossing);
          const double steepness = glm::length(slope);
          if (steepness > 0.0) area += std::abs(slope[a]) / steepness;
        }
  area *= grid_.spacing * grid_.spacing;
  if (!(area > 0.0)) return {};
  const float depth = static_cast<float>(std::min(volume / area, 0.5 * grid_.spacing));
  const double band_now = band();
  return Edit(nodes, [&](int i, int j, int k, float& value, float& cut) {
    const double d = tool[local(i, j, k)];
    if (!std::isfinite(d)) return;
    const float taken =
        std::min(static_cast<float>(std::clamp(-d, -band_now, band_now)), value + depth);
    value = std::max(value, taken);
    cut = std::max(cut, taken);
  });
}

FieldEdit SolidField::RemoveNodes(std::span<const std::size_t> nodes) {
  FieldEdit edit;
  if (nodes.empty() || value_.empty()) return edit;
  std::vector<std::size_t> sorted(nodes.begin(), nodes.end());
  std::sort(sorted.begin(), sorted.end());
  NodeBox box{grid_.count, {-1, -1, -1}};
  const auto nx = static_cast<std::size_t>(grid_.count[0]),
             ny = static_cast<std::size_t>(grid_.count[1]);
  for (const std::size_t node : sorted) {
    const std::array<int, 3> at = {static_cast<int>(node % nx), static_cast<int>(node / nx % ny),
                                   static_cast<int>(node / nx / ny)};
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], at[a]);
      box.high[a] = std::max(box.high[a], at[a]);
    }
  }
  // Places the values half a spacing outside, as if a surface passed between the node and its
  // neighbours.
  const float gone = static_cast<float>(0.5 * grid_.spacing);
  return Edit(box, [&](int i, int j, int k, float& value, float& cut) {
    if (!std::binary_search(sorted.begin(), sorted.end(), grid_.Index(i, j, k))) return;
    value = std::max(value, gone);
    cut = std::max(cut, gone);
  });
}

}  // namespace arthro::simulation
