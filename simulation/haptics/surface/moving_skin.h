// Contact with a triangle surface that moves, as the skin of a deformable tissue: sweeps a ball as
// SurfaceBvh does, over a tree of boxes that is refitted after each motion. Portal frame, m.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/geometry/box_tree.h"
#include "simulation/core/geometry/segment3.h"
#include "simulation/core/geometry/triangle.h"
#include "simulation/haptics/surface/swept_surface.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::simulation {

class MovingSkin : public SweptSurface {
 public:
  // `surface` gives the triangles and the first place of the vertices.
  explicit MovingSkin(const SurfaceMesh& surface);

  // Moves the vertices, one position each.
  void Move(std::span<const glm::dvec3> positions) noexcept;
  // Box of all triangles.
  const Box3& box() const noexcept { return tree_.box(); }
  bool empty() const noexcept { return tree_.empty(); }

  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
             SweepHit& hit) const noexcept override;
  bool IsFree(const glm::dvec3& x, double radius) const noexcept override;
  // Returns true where the segment crosses a triangle, from either side.
  bool IsCrossed(const Segment3& segment) const noexcept;
  // Returns the way by which a ball at `x`, which the skin moved over, comes out of it; zero where
  // it is free. The nearest triangle tells its side.
  glm::dvec3 WayOut(const glm::dvec3& x, double radius) const noexcept;

 private:
  TriangleCorners CornersOfTriangle(int triangle) const noexcept;

  std::vector<std::array<int, 3>> triangles_;
  std::vector<glm::dvec3> vertices_;
  BoxTree tree_;
};

}  // namespace arthro::simulation
