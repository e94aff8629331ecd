// Smooth normals of a surface: the sum of the adjoining triangles' normals by area, unit; (0, 0, 1)
// for a vertex without area.
#pragma once

#include <array>
#include <span>

#include <glm/vec3.hpp>

namespace arthro {

// Unit normals, one per vertex.
void ComputeVertexNormals(std::span<const glm::dvec3> vertices,
                          std::span<const std::array<int, 3>> triangles,
                          std::span<glm::dvec3> normals) noexcept;

}  // namespace arthro
