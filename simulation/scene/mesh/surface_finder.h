// Nearest point of a triangle surface, by a bounding-volume hierarchy. m, the surface's own frame.
#pragma once

#include <limits>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/geometry/box_tree.h"
#include "simulation/core/geometry/triangle.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro {

// Point of a surface: triangle −1 for none.
struct SurfacePoint {
  int triangle = -1;
  glm::dvec3 at{0.0};     // barycentric coordinates
  glm::dvec3 place{0.0};  // m
};

class SurfaceFinder {
 public:
  explicit SurfaceFinder(const SurfaceMesh& surface);

  // Returns the nearest point within `reach`, the first of equals in the tree's order.
  SurfacePoint Find(const glm::dvec3& x,
                    double reach = std::numeric_limits<double>::infinity()) const noexcept;
  // Returns the place of the nearest point within `reach`, or x itself when there is none.
  glm::dvec3 Nearest(const glm::dvec3& x,
                     double reach = std::numeric_limits<double>::infinity()) const noexcept;

 private:
  std::vector<TriangleCorners> triangles_;
  BoxTree tree_;
};

// Returns the box around three corners.
Box3 BoxOf(const TriangleCorners& corner) noexcept;
// Returns the corners of a triangle of a surface.
TriangleCorners CornersOf(const SurfaceMesh& surface, std::size_t triangle) noexcept;

}  // namespace arthro
