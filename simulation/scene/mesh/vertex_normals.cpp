#include "simulation/scene/mesh/vertex_normals.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace arthro {

void ComputeVertexNormals(std::span<const glm::dvec3> vertices,
                          std::span<const std::array<int, 3>> triangles,
                          std::span<glm::dvec3> normals) noexcept {
  std::fill(normals.begin(), normals.end(), glm::dvec3(0.0));
  for (const auto& triangle : triangles) {
    const auto a = static_cast<std::size_t>(triangle[0]), b = static_cast<std::size_t>(triangle[1]),
               c = static_cast<std::size_t>(triangle[2]);
    const glm::dvec3 twice_area = glm::cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
    normals[a] += twice_area;
    normals[b] += twice_area;
    normals[c] += twice_area;
  }
  for (glm::dvec3& normal : normals) {
    const double length = glm::length(normal);
    normal = length > 0.0 ? normal / length : glm::dvec3(0.0, 0.0, 1.0);
  }
}

}  // namespace arthro
