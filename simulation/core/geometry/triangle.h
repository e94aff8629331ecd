// Closest point of a triangle, exact for face, edges and corners, degenerate triangles included
// [Ericson 2005, 5.1.5]. m; noexcept, allocates nothing.
#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace arthro {

using TriangleCorners = std::array<glm::dvec3, 3>;

// Returns the barycentric coordinates of the point of a triangle that is nearest to x.
glm::dvec3 ClosestOnTriangle(const TriangleCorners& corner, const glm::dvec3& x) noexcept;

// Returns the point with barycentric coordinates l.
inline glm::dvec3 PointOn(const TriangleCorners& corner, const glm::dvec3& l) noexcept {
  return l.x * corner[0] + l.y * corner[1] + l.z * corner[2];
}

// Returns the squared distance of x from a triangle.
double Distance2(const TriangleCorners& corner, const glm::dvec3& x) noexcept;

}  // namespace arthro
