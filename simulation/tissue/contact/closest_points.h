// Closest points of simple shapes: exact for faces, edges and corners, including degenerate shapes
// [Ericson 2005, 5.1]. m; noexcept, allocates nothing.
#pragma once

#include <array>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/core/geometry/triangle.h"

namespace arthro::simulation {

// Returns the barycentric coordinates of the point of a tetrahedron nearest to x (x itself if
// inside). Either handedness is accepted; a flat tetrahedron counts as its faces.
glm::dvec4 ClosestInTetrahedron(const std::array<glm::dvec3, 4>& corner,
                                const glm::dvec3& x) noexcept;

// Closest points of a segment and a triangle.
struct SegmentTriangle {
  double along = 0;              // position on the segment, 0 at a, 1 at b
  glm::dvec3 triangle{1, 0, 0};  // barycentric coordinates in the triangle
  double distance2 = 0;          // m²; 0 if the segment passes through
};
// If a stretch of the segment is equally near (parallel to the face or an edge), returns its
// middle.
SegmentTriangle ClosestSegmentTriangle(const glm::dvec3& a, const glm::dvec3& b,
                                       const TriangleCorners& corner) noexcept;

}  // namespace arthro::simulation
