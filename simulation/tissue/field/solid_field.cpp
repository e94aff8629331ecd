#include "simulation/tissue/field/solid_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/tissue/field/cell_volume.h"
#include "simulation/tissue/field/surface_distance.h"

namespace arthro::simulation {
namespace {

// Distances are kept up to this many spacings: at 0.35 mm 5.6 mm, the depth of a whole meniscus.
constexpr double kBandCells = 16.0;
// Nodes around the box of a surface, so that nearby queries find distances and not bounds.
constexpr int kMargin = 4;
// The grid stands off from the box by this part of a spacing, so that round coordinates of meshes
// and planes do not fall on its nodes.
constexpr double kOffset = 0.381966;
constexpr std::int64_t kCellUnits = std::int64_t{1} << 30;

// Where in the grid x is: cell and part of it, for x clamped into the grid.
struct CellPlace {
  std::size_t index;
  glm::dvec3 part, clamped;
};

CellPlace Locate(const FieldGrid& grid, const glm::dvec3& x) noexcept {
  CellPlace place;
  std::array<int, 3> cell;
  const double per_spacing = 1.0 / grid.spacing;
  for (int a = 0; a < 3; ++a) {
    const int last = grid.count[static_cast<std::size_t>(a)] - 1;
    // In this order NaN becomes 0.
    const double t =
        std::min(std::max(0.0, (x[a] - grid.origin[a]) * per_spacing), static_cast<double>(last));
    const int i = std::min(static_cast<int>(t), last - 1);
    cell[static_cast<std::size_t>(a)] = i;
    place.part[a] = t - i;
    place.clamped[a] = grid.origin[a] + t * grid.spacing;
  }
  place.index = grid.Index(cell[0], cell[1], cell[2]);
  return place;
}

struct Corners {
  std::array<double, 8> value;
};

Corners CornersAt(std::span<const float> values, const FieldGrid& grid,
                  std::size_t index) noexcept {
  const std::size_t row = static_cast<std::size_t>(grid.count[0]);
  const std::size_t layer = row * static_cast<std::size_t>(grid.count[1]);
  return {{values[index], values[index + 1], values[index + row], values[index + row + 1],
           values[index + layer], values[index + layer + 1], values[index + layer + row],
           values[index + layer + row + 1]}};
}

double Interpolate(const Corners& corners, const glm::dvec3& t) noexcept {
  const auto& c = corners.value;
  const double x00 = c[0] + t.x * (c[1] - c[0]), x10 = c[2] + t.x * (c[3] - c[2]);
  const double x01 = c[4] + t.x * (c[5] - c[4]), x11 = c[6] + t.x * (c[7] - c[6]);
  const double y0 = x00 + t.y * (x10 - x00), y1 = x01 + t.y * (x11 - x01);
  return y0 + t.z * (y1 - y0);
}

double OutsideOf(const Box3& box, const glm::dvec3& x) noexcept {
  const glm::dvec3 centre = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const glm::dvec3 q = glm::abs(x - centre) - half;
  return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

}  // namespace

void SolidField::Prepare(const Box3& box, double spacing, std::int64_t max_cells) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw Error(Code::kBadArgument,
                fmt::format("a field's spacing must be positive, not {}", spacing));
  grid_.spacing = spacing;
  double cells = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double span = std::ceil((box.high[a] - box.low[a]) / spacing) + 2 * kMargin + 1;
    if (!std::isfinite(span) || span < 2.0)
      throw Error(Code::kBadArgument, "a field's box must be finite and not inside out");
    cells *= span;
    if (cells > static_cast<double>(max_cells)) break;
    grid_.count[static_cast<std::size_t>(a)] = static_cast<int>(span) + 1;
    grid_.origin[a] = box.low[a] - (kMargin + kOffset) * spacing;
    bricks_[static_cast<std::size_t>(a)] = (static_cast<int>(span) + kBrick - 1) / kBrick;
  }
  if (cells > static_cast<double>(max_cells))
    throw Error(Code::kBadArgument,
                fmt::format("a field of spacing {:.3g} mm would have more than {} cells; take a "
                            "larger spacing or a smaller box",
                            1e3 * spacing, max_cells));
  const auto brick_count = static_cast<std::size_t>(bricks_[0]) *
                           static_cast<std::size_t>(bricks_[1]) *
                           static_cast<std::size_t>(bricks_[2]);
  brick_volume_.assign(brick_count, 0);
  brick_version_.assign(brick_count, 0);
}

SolidField SolidField::FromSurface(const SurfaceMesh& surface, double spacing,
                                   std::int64_t max_cells) {
  SolidField field;
  Box3 box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (const auto& triangle : surface.triangles)
    for (const int vertex : triangle)
      if (vertex >= 0 && vertex < static_cast<int>(surface.vertices.size())) {
        const glm::dvec3& x = surface.vertices[static_cast<std::size_t>(vertex)];
        box.low = glm::min(box.low, x);
        box.high = glm::max(box.high, x);
      }
  if (surface.triangles.empty() || box.empty() || !std::isfinite(glm::length(box.high - box.low)))
    throw Error(Code::kBadMesh, "the surface is empty or not finite; a solid needs a closed one");
  field.Prepare(box, spacing, max_cells);
  field.value_ = SignedDistances(surface, field.grid_, field.band());
  field.SumBricks();
  return field;
}

SolidField SolidField::FromFunction(const Box3& box, double spacing,
                                    const std::function<double(const glm::dvec3&)>& distance,
                                    std::int64_t max_cells) {
  SolidField field;
  field.Prepare(box, spacing, max_cells);
  field.value_.resize(field.grid_.NodeCount());
  const auto& n = field.grid_.count;
  const double band = field.band();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const glm::dvec3 x = field.grid_.Place(i, j, k);
        const double d = std::max(distance(x), OutsideOf(box, x));
        // NaN becomes −band and is then outside of the box: not solid.
        field.value_[field.grid_.Index(i, j, k)] =
            static_cast<float>(std::isfinite(d) ? std::clamp(d, -band, band) : band);
      }
  field.SumBricks();
  return field;
}

void SolidField::SumBricks() {
  for (int k = 0; k < bricks_[2]; ++k)
    for (int j = 0; j < bricks_[1]; ++j)
      for (int i = 0; i < bricks_[0]; ++i)
        volume_ += brick_volume_[BrickIndex(i, j, k)] = BrickVolume(i, j, k);
}

double SolidField::band() const { return kBandCells * grid_.spacing; }

Box3 SolidField::box() const {
  return {grid_.origin, grid_.Place(grid_.count[0] - 1, grid_.count[1] - 1, grid_.count[2] - 1)};
}

double SolidField::Volume() const { return VolumeOf(volume_); }

double SolidField::Distance(const glm::dvec3& x) const noexcept {
  if (value_.empty()) return band();
  const CellPlace place = Locate(grid_, x);
  const double inside = Interpolate(CornersAt(value_, grid_, place.index), place.part);
  const glm::dvec3 beyond = x - place.clamped;
  const double outside2 = glm::dot(beyond, beyond);
  // Nothing of the solid is outside the box, so of any point of it the place is at least as far as
  // Pythagoras says.
  if (!(outside2 > 1e-18 * grid_.spacing * grid_.spacing)) return inside;
  return std::min(band(), std::sqrt(outside2 + inside * inside));
}

glm::dvec3 SolidField::Gradient(const glm::dvec3& x) const noexcept {
  if (value_.empty()) return glm::dvec3(0.0);
  const CellPlace place = Locate(grid_, x);
  const auto c = CornersAt(value_, grid_, place.index).value;
  const glm::dvec3 &t = place.part, s = 1.0 - t;
  const glm::dvec3 slope = glm::dvec3(s.z * (s.y * (c[1] - c[0]) + t.y * (c[3] - c[2])) +
                                          t.z * (s.y * (c[5] - c[4]) + t.y * (c[7] - c[6])),
                                      s.z * (s.x * (c[2] - c[0]) + t.x * (c[3] - c[1])) +
                                          t.z * (s.x * (c[6] - c[4]) + t.x * (c[7] - c[5])),
                                      s.y * (s.x * (c[4] - c[0]) + t.x * (c[5] - c[1])) +
                                          t.y * (s.x * (c[6] - c[2]) + t.x * (c[7] - c[3]))) /
                           grid_.spacing;
  const glm::dvec3 beyond = x - place.clamped;
  const double outside2 = glm::dot(beyond, beyond);
  if (!(outside2 > 1e-18 * grid_.spacing * grid_.spacing)) return slope;
  const double inside = Interpolate({c}, place.part);
  return (beyond + inside * slope) / std::sqrt(outside2 + inside * inside);
}

double SolidField::CutDistance(const glm::dvec3& x) const noexcept {
  if (cut_.empty()) return -band();
  const CellPlace place = Locate(grid_, x);
  return Interpolate(CornersAt(cut_, grid_, place.index), place.part);
}

void SolidField::CutDistances(std::span<const glm::dvec3> x, std::span<double> distance,
                              std::span<NodeNear> node) const noexcept {
  for (std::size_t i = 0; i < x.size(); ++i) {
    distance[i] = -band();
    node[i] = {};
    if (cut_.empty()) continue;
    const CellPlace place = Locate(grid_, x[i]);
    const Corners corners = CornersAt(cut_, grid_, place.index);
    distance[i] = Interpolate(corners, place.part);
    if (distance[i] > 0.0) continue;
    const std::size_t row = static_cast<std::size_t>(grid_.count[0]);
    const std::size_t layer = row * static_cast<std::size_t>(grid_.count[1]);
    const auto index = [&](std::size_t c) {
      return static_cast<std::int32_t>(place.index + (c & 1) + (c >> 1 & 1) * row +
                                       (c >> 2) * layer);
    };
    for (const double value : corners.value) node[i].is_cell_whole &= value <= 0.0;
    const glm::dvec3& t = place.part;
    if (node[i].is_cell_whole) {
      node[i].index = index((t.x > 0.5 ? 1u : 0u) + (t.y > 0.5 ? 2u : 0u) + (t.z > 0.5 ? 4u : 0u));
      continue;
    }
    // A value of zero or less has a corner of zero or less.
    double largest = -1.0;
    for (std::size_t c = 0; c < 8; ++c) {
      const double weight = ((c & 1) != 0 ? t.x : 1 - t.x) * ((c & 2) != 0 ? t.y : 1 - t.y) *
                            ((c & 4) != 0 ? t.z : 1 - t.z);
      if (corners.value[c] > 0.0 || weight <= largest) continue;
      largest = weight;
      node[i].index = index(c);
    }
  }
}

bool SolidField::AreJoined(const NodeNear& a, const NodeNear& b) const noexcept {
  // Two cells a spacing apart have a corner in common.
  if (a.index == b.index || (a.is_cell_whole && b.is_cell_whole)) return true;
  if (a.index < 0 || b.index < 0) return false;
  const auto at = [&](std::int32_t node) {
    const int nx = grid_.count[0], ny = grid_.count[1];
    return std::array<int, 3>{node % nx, node / nx % ny, node / nx / ny};
  };
  const std::array<int, 3> from = at(a.index), to = at(b.index);
  std::array<int, 3> low, size;
  int beside = 0;  // steps between them
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(from[i], to[i]);
    size[i] = std::abs(from[i] - to[i]) + 1;
    beside += size[i] - 1;
  }
  if (beside == 1) return true;
  if (size[0] * size[1] * size[2] > 64) return false;  // further apart than neighbours can be
  // Flooded from a: one bit a node of the box.
  const auto bit = [&](int i, int j, int k) {
    return std::uint64_t{1} << ((k * size[1] + j) * size[0] + i);
  };
  std::uint64_t solid = 0;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        if (cut_[grid_.Index(low[0] + i, low[1] + j, low[2] + k)] <= 0.0f) solid |= bit(i, j, k);
  const std::uint64_t goal = bit(to[0] - low[0], to[1] - low[1], to[2] - low[2]);
  std::uint64_t reached = bit(from[0] - low[0], from[1] - low[1], from[2] - low[2]), last = 0;
  while (reached != last && (reached & goal) == 0) {
    last = reached;
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) {
          if ((solid & bit(i, j, k)) == 0) continue;
          const bool is_beside = (i > 0 && (reached & bit(i - 1, j, k)) != 0) ||
                                 (i + 1 < size[0] && (reached & bit(i + 1, j, k)) != 0) ||
                                 (j > 0 && (reached & bit(i, j - 1, k)) != 0) ||
                                 (j + 1 < size[1] && (reached & bit(i, j + 1, k)) != 0) ||
                                 (k > 0 && (reached & bit(i, j, k - 1)) != 0) ||
                                 (k + 1 < size[2] && (reached & bit(i, j, k + 1)) != 0);
          if (is_beside) reached |= bit(i, j, k);
        }
  }
  return (reached & goal) != 0;
}

bool SolidField::MayBeCut(const Box3& box) const noexcept {
  if (cut_.empty() || box.empty()) return false;
  // All nodes of all cells that the box meets, clamped into the grid as queries are.
  std::array<int, 3> first, last;
  for (int a = 0; a < 3; ++a) {
    const double end = grid_.count[static_cast<std::size_t>(a)] - 1;
    const auto node = [&](double x) { return std::min(std::max(0.0, x), end); };
    const double low = (box.low[a] - grid_.origin[a]) / grid_.spacing;
    const double high = (box.high[a] - grid_.origin[a]) / grid_.spacing;
    first[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(node(low)));
    last[static_cast<std::size_t>(a)] = static_cast<int>(std::ceil(node(high)));
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        if (cut_[grid_.Index(i, j, k)] > 0.0f) return true;
  return false;
}

SolidField::NodeBox SolidField::NodesIn(const Box3& box) const {
  NodeBox nodes;
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const double last = grid_.count[i] - 1;
    const double low = std::ceil((box.low[a] - grid_.origin[a]) / grid_.spacing);
    const double high = std::floor((box.high[a] - grid_.origin[a]) / grid_.spacing);
    // A box that is not finite in a direction is clamped; NaN makes it empty.
    nodes.low[i] = low <= last ? static_cast<int>(std::max(0.0, low)) : grid_.count[i];
    nodes.high[i] = high >= 0.0 ? static_cast<int>(std::min(last, high)) : -1;
  }
  return nodes;
}

std::int64_t SolidField::CellUnits(int i, int j, int k) const {
  const double part = SolidPart(CornersAt(value_, grid_, grid_.Index(i, j, k)).value);
  return std::llround(part * static_cast<double>(kCellUnits));
}

double SolidField::VolumeOf(std::int64_t units) const {
  return static_cast<double>(units) / static_cast<double>(kCellUnits) * grid_.spacing *
         grid_.spacing * grid_.spacing;
}

double SolidField::CellVolume(int i, int j, int k) const { return VolumeOf(CellUnits(i, j, k)); }

std::int64_t SolidField::BrickVolume(int bi, int bj, int bk) const {
  std::int64_t sum = 0;
  const auto end = [&](int b, std::size_t a) {
    return std::min((b + 1) * kBrick, grid_.count[a] - 1);
  };
  for (int k = bk * kBrick; k < end(bk, 2); ++k)
    for (int j = bj * kBrick; j < end(bj, 1); ++j)
      for (int i = bi * kBrick; i < end(bi, 0); ++i) sum += CellUnits(i, j, k);
  return sum;
}

// Is any cell about node (i, j, k) crossed by the surface?
bool SolidField::IsAtSurface(int i, int j, int k) const {
  const bool is_solid = value_[grid_.Index(i, j, k)] < 0;
  const auto& n = grid_.count;
  for (int c = std::max(0, k - 1); c <= std::min(n[2] - 1, k + 1); ++c)
    for (int b = std::max(0, j - 1); b <= std::min(n[1] - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(n[0] - 1, i + 1); ++a)
        if ((value_[grid_.Index(a, b, c)] < 0) != is_solid) return true;
  return false;
}

// `change(i, j, k, value, cut)` gives a node its new values. A brick has changed when a node of one
// of its cells changed sides, or a node of one that the surface passes through changed its value;
// those bricks are summed anew.
template <class Change>
FieldEdit SolidField::Edit(const NodeBox& nodes, const Change& change) {
  FieldEdit edit;
  for (std::size_t a = 0; a < 3; ++a)
    if (nodes.low[a] > nodes.high[a]) return edit;
  if (cut_.empty()) cut_.assign(value_.size(), static_cast<float>(-band()));
  NodeBox near{grid_.count, {-1, -1, -1}};  // where the surface or the cut may have moved
  bool has_changed = false;
  // A value deeper than the diagonals of two cells has no part in any cell of the surface.
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
    if (!std::isfinite(d)) return;  // no place for a tool to be
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
    return static_cast<std::size_t>(nodes.high[a] - nodes.low[a] + 1);
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
  // Area of the surface in the tool: a surface of unit normal n crosses |n_a|/h² grid edges along
  // axis a on each unit of area, so |n_a| h², summed over all crossings, is the area.
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
  // Half a spacing into the removed side, as if a surface passed between it and its neighbours.
  const float gone = static_cast<float>(0.5 * grid_.spacing);
  return Edit(box, [&](int i, int j, int k, float& value, float& cut) {
    if (!std::binary_search(sorted.begin(), sorted.end(), grid_.Index(i, j, k))) return;
    value = std::max(value, gone);
    cut = std::max(cut, gone);
  });
}

}  // namespace arthro::simulation
