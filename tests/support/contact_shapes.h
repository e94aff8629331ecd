// Closed surfaces whose contact is known in closed form. m.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/vec3.hpp>

#include "simulation/scene/surface_mesh.h"

namespace arthro::test {

// Sides 2·half about `centre`; `inwards`: a room seen from within.
inline SurfaceMesh Box(const glm::dvec3& centre, const glm::dvec3& half, bool inwards = false) {
  SurfaceMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(centre +
                            half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  if (inwards)
    for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

// Meridians and parallels; 2·parallels² triangles or so, corners on the sphere.
inline SurfaceMesh Ball(const glm::dvec3& centre, double radius, int parallels) {
  SurfaceMesh mesh;
  const int around = 2 * parallels;
  mesh.vertices.push_back(centre + glm::dvec3(0, 0, radius));
  for (int i = 1; i < parallels; ++i)
    for (int j = 0; j < around; ++j) {
      const double polar = std::numbers::pi * i / parallels,
                   turn = 2 * std::numbers::pi * j / around;
      mesh.vertices.push_back(centre + radius * glm::dvec3(std::sin(polar) * std::cos(turn),
                                                           std::sin(polar) * std::sin(turn),
                                                           std::cos(polar)));
    }
  mesh.vertices.push_back(centre - glm::dvec3(0, 0, radius));
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * around + (j + around) % around; };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < parallels; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(parallels - 1, j + 1), at(parallels - 1, j), last});
  }
  return mesh;
}

}  // namespace arthro::test
