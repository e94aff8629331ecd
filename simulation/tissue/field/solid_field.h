// Solid region of space as a sampled signed distance (negative inside) on a regular grid of floats.
// It is the rest shape of a tissue, from which bites and shavings are removed by Boolean
// subtraction, and the implicit-function tissue of [paper, 3.4]. The surface is the zero of the
// trilinear interpolation; the resolution is the grid spacing. m.
//
// Queries are noexcept and allocate nothing. Edits touch only the nodes of their box; bricks of 8³
// cells record when their surface last changed. The outermost nodes are never solid, so the surface
// is closed.
//
// The volume removed by edits is also kept separately (CutDistance), without the original shape. A
// mesh that only approximates the surface is cut by that copy, so that its facets alone change
// nothing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/geometry/box3.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::simulation {

struct FieldEdit {
  double removed = 0;        // m³ that were solid and are no longer (sub-cell); negative: added
  Box3 changed = kEmptyBox;  // empty: nothing changed
};

// Grid of the field: node (i, j, k) stands at origin + spacing (i, j, k), i runs fastest.
struct FieldGrid {
  glm::dvec3 origin{0.0};
  double spacing = 1;
  std::array<int, 3> count{0, 0, 0};  // nodes
  std::size_t NodeCount() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
           static_cast<std::size_t>(count[2]);
  }
  std::size_t Index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(count[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(count[0]) +
           static_cast<std::size_t>(i);
  }
  glm::dvec3 Place(int i, int j, int k) const { return origin + spacing * glm::dvec3(i, j, k); }
};

// Node of a point: the nearest corner of its cell that was not removed.
struct NodeNear {
  std::int32_t index = -1;    // in the grid; −1: all were removed, or none was near
  bool is_cell_whole = true;  // no corner of the cell was removed
};

class SolidField {
 public:
  static constexpr int kBrick = 8;  // cells per edge

  SolidField() = default;  // nothing solid anywhere
  // Computes the distance to a closed surface with the given grid spacing (m). Distances up to
  // `around` (m) outside the surface are exact; beyond that they are bounds. Throws Error(kBadMesh)
  // for a surface that is empty, open or not finite. Throws Error(kBadArgument) for a grid of more
  // than `max_cells`.
  static SolidField FromSurface(const SurfaceMesh& surface, double spacing,
                                std::int64_t max_cells = 20'000'000, double around = 0);
  // Samples a function over a box; the solid ends at the sides of the box.
  static SolidField FromFunction(const Box3& box, double spacing,
                                 const std::function<double(const glm::dvec3&)>& distance,
                                 std::int64_t max_cells = 20'000'000);

  // Returns the distance, clamped to ± band(). Outside box() it is a lower bound, continuous at the
  // sides.
  double Distance(const glm::dvec3& x) const noexcept;
  glm::dvec3 Gradient(
      const glm::dvec3& x) const noexcept;  // gradient of the trilinear interpolation
  // Returns the distance to the removed volume only: positive in it, negative elsewhere, −band()
  // where no edit came near.
  double CutDistance(const glm::dvec3& x) const noexcept;
  // Evaluates CutDistance at many points. For points where it is not positive, also returns the
  // remaining grid node to which the point belongs.
  void CutDistances(std::span<const glm::dvec3> x, std::span<double> distance,
                    std::span<NodeNear> node) const noexcept;
  // Returns whether two points at most one spacing apart are connected along grid edges. Contact at
  // a cell corner alone does not count, as in the skin and the pieces.
  bool AreJoined(const NodeNear& a, const NodeNear& b) const noexcept;
  // Returns whether CutDistance may be positive anywhere in the box; false is certain.
  bool MayBeCut(const Box3& box) const noexcept;

  double spacing() const { return grid_.spacing; }
  double band() const;  // m; beyond it only the sign of a distance is known
  Box3 box() const;
  double Volume() const;  // m³ that are solid now

  // Removes, within `box`, the region with distance(x) < 0 (max(old, −distance)). The box should
  // extend two spacings beyond that region; otherwise the new surface ends at the sides of the box.
  FieldEdit Subtract(const Box3& box, const std::function<double(const glm::dvec3&)>& distance);
  // Adds the region with distance(x) < 0 (min(old, distance)), also within box().
  FieldEdit Add(const Box3& box, const std::function<double(const glm::dvec3&)>& distance);
  // Removes about `volume` (m³) of the region with distance(x) < 0, evenly from the surface inwards
  // and at most half a spacing at once: the window of a shaver.
  FieldEdit Erode(const Box3& box, const std::function<double(const glm::dvec3&)>& distance,
                  double volume);
  // Removes these nodes (indices of grid()) whatever their value: crumbs.
  FieldEdit RemoveNodes(std::span<const std::size_t> nodes);

  // Version that grows with every edit that changed something.
  std::uint64_t version() const { return version_; }

  // Solid volume of one cell, m³, in the integer units in which Volume() and FieldEdit::removed are
  // summed.
  double CellVolume(int i, int j, int k) const;

  // Grid access for the polygoniser and the pieces.
  const FieldGrid& grid() const { return grid_; }
  std::span<const float> values() const { return value_; }  // one per node
  // CutDistance at the nodes; empty before the first edit.
  std::span<const float> cut_values() const { return cut_; }
  std::array<int, 3> bricks() const { return bricks_; }
  // version() of the last change of the surface in each brick of bricks(), i fastest.
  std::span<const std::uint64_t> brick_versions() const { return brick_version_; }

 private:
  struct NodeBox {
    std::array<int, 3> low, high;  // inclusive
  };
  NodeBox NodesIn(const Box3& box) const;
  void Prepare(const Box3& box, double spacing, std::int64_t max_cells);
  void SumBricks();
  std::int64_t CellUnits(int i, int j, int k) const;
  double VolumeOf(std::int64_t units) const;
  std::int64_t BrickVolume(int bi, int bj, int bk) const;
  bool IsAtSurface(int i, int j, int k) const;
  std::size_t BrickIndex(int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(bricks_[0]), ny = static_cast<std::size_t>(bricks_[1]);
    return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
           static_cast<std::size_t>(i);
  }
  template <class Change>
  FieldEdit Edit(const NodeBox& nodes, const Change& change);

  FieldGrid grid_;
  std::vector<float> value_, cut_;  // cut_ is empty until the first edit
  std::array<int, 3> bricks_{0, 0, 0};
  // Solid volume per brick in units of 2^-30 of a cell. With integers, removed and remaining volume
  // add up exactly.
  std::vector<std::int64_t> brick_volume_;
  std::vector<std::uint64_t> brick_version_;
  std::int64_t volume_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace arthro::simulation
