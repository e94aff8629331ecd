// A triangle surface as a plain value. Vertices in metres; triangles are counter-clockwise seen
// from outside.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace arthro {

struct SurfaceMesh {
  std::vector<glm::dvec3> vertices;           // m
  std::vector<std::array<int, 3>> triangles;  // indices into vertices
};

}  // namespace arthro
