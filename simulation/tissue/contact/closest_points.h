// Closest points of simple shapes, exact for faces, edges and corners, degenerate shapes included
// [Ericson 2005, 5.1]. m; noexcept, allocates nothing.
#pragma once

#include <array>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/core/triangle.h"

namespace arthro::simulation {

// Barycentric coordinates of the point of a tetrahedron that is nearest to x (x itself, inside it).
// Either handedness will do; a flat one is its faces.
glm::dvec4 ClosestInTetrahedron(const std::array<glm::dvec3, 4>& corner,
                                const glm::dvec3& x) noexcept;

// The two nearest points of a segment and a triangle.
struct SegmentTriangle {
  double along = 0;              // of the segment's point, 0 at a, 1 at b
  glm::dvec3 triangle{1, 0, 0};  // barycentric, of the triangle's point
  double distance2 = 0;          // m²; 0 where the segment goes through
};
// Where a whole stretch of the segment is nearest (parallel to the face or an edge), its middle.
SegmentTriangle ClosestSegmentTriangle(const glm::dvec3& a, const glm::dvec3& b,
                                       const TriangleCorners& corner) noexcept;

}  // namespace arthro::simulation
