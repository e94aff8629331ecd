// Which part of space is solid, as a sampled signed distance (negative inside) on a regular grid of
// float values: the shape of a tissue at rest, of which bites and shavings are taken by Boolean
// subtraction, and the implicit-function tissue of paper 3.4. The surface that it stands for is the
// zero of its trilinear interpolation; its resolution is the grid's spacing. m. Queries are
// noexcept and allocate nothing. Edits touch only the nodes of their box, and bricks of 8³ cells
// know when their surface last changed. The outermost nodes are never solid, so the surface is
// closed.
//
// What edits took away is kept a second time on its own (CutDistance), without the original shape:
// a mesh that only approximates the surface is cut by that, so that its facets alone change
// nothing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/box3.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro::simulation {

struct FieldEdit {
  double removed = 0;        // m³ that were solid and are not any more (sub-cell); negative: added
  Box3 changed = kEmptyBox;  // empty: nothing changed
};

// The nodes of a field: node (i, j, k) stands at origin + spacing (i, j, k), i runs fastest.
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

// A place's node: the nearest corner of its cell that was not taken away.
struct NodeNear {
  std::int32_t index = -1;    // in the grid; −1: all were, or none near was
  bool is_cell_whole = true;  // no corner of the cell was
};

class SolidField {
 public:
  static constexpr int kBrick = 8;  // cells an edge

  SolidField() = default;  // nothing solid anywhere
  // Distance to a closed surface. `spacing`: of the grid, m. Throws Error(kBadMesh) for a surface
  // that is empty, open or not finite and Error(kBadArgument) for a grid of more than `max_cells`.
  // `around`: how far outside of the surface distances are still known, and not only a bound, m.
  static SolidField FromSurface(const SurfaceMesh& surface, double spacing,
                                std::int64_t max_cells = 20'000'000, double around = 0);
  // From a function, over a box, at whose sides the solid ends.
  static SolidField FromFunction(const Box3& box, double spacing,
                                 const std::function<double(const glm::dvec3&)>& distance,
                                 std::int64_t max_cells = 20'000'000);

  // Clamped to ± band(). Outside box(): a lower bound, continuous at its sides.
  double Distance(const glm::dvec3& x) const noexcept;
  glm::dvec3 Gradient(const glm::dvec3& x) const noexcept;  // of the trilinear interpolation
  // The same of what edits took away alone: positive where it was taken, negative elsewhere,
  // −band() where no edit came near.
  double CutDistance(const glm::dvec3& x) const noexcept;
  // CutDistance at many places and, where it is not positive, to which of the grid's nodes that
  // were not taken away the place belongs.
  void CutDistances(std::span<const glm::dvec3> x, std::span<double> distance,
                    std::span<NodeNear> node) const noexcept;
  // Do two places no more than a spacing apart hang together along grid edges? What only touches
  // at a corner of a cell does not, as in the skin and the pieces.
  bool AreJoined(const NodeNear& a, const NodeNear& b) const noexcept;
  // Could CutDistance be positive anywhere in the box? False is certain.
  bool MayBeCut(const Box3& box) const noexcept;

  double spacing() const { return grid_.spacing; }
  double band() const;  // m, beyond which distances are only a sign
  Box3 box() const;
  double Volume() const;  // m³ solid now

  // Takes away, within `box`, what lies where distance(x) < 0 (max(old, −distance)). The box should
  // reach two spacings past that, or the new surface ends at its sides.
  FieldEdit Subtract(const Box3& box, const std::function<double(const glm::dvec3&)>& distance);
  // Puts back or adds (min(old, distance)), within box() too.
  FieldEdit Add(const Box3& box, const std::function<double(const glm::dvec3&)>& distance);
  // Takes away about `volume` (m³) of what lies where distance(x) < 0, evenly from the surface
  // inwards and no deeper than half a spacing at once: a shaver's window.
  FieldEdit Erode(const Box3& box, const std::function<double(const glm::dvec3&)>& distance,
                  double volume);
  // Takes away these nodes (indices of grid()) whatever their value: crumbs.
  FieldEdit RemoveNodes(std::span<const std::size_t> nodes);

  // Grows with every edit that changed something.
  std::uint64_t version() const { return version_; }

  // Solid in one cell, m³, in the whole units that Volume() and FieldEdit::removed are sums of.
  double CellVolume(int i, int j, int k) const;

  // For who walks the grid: polygoniser, pieces.
  const FieldGrid& grid() const { return grid_; }
  std::span<const float> values() const { return value_; }  // one a node
  std::array<int, 3> bricks() const { return bricks_; }
  // version() when the surface in a brick of bricks(), i fastest, last changed.
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
    return static_cast<std::size_t>((k * bricks_[1] + j) * bricks_[0] + i);
  }
  template <class Change>
  FieldEdit Edit(const NodeBox& nodes, const Change& change);

  FieldGrid grid_;
  std::vector<float> value_, cut_;  // cut_ is empty until the first edit
  std::array<int, 3> bricks_{0, 0, 0};
  // Solid volume a brick, in 2^-30 of a cell: whole numbers, so that what is taken away and what
  // remains are together exactly what was there.
  std::vector<std::int64_t> brick_volume_;
  std::vector<std::uint64_t> brick_version_;
  std::int64_t volume_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace arthro::simulation
