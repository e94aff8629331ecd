// Closed surfaces made in code, facing outwards, metres.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::test {

inline SurfaceMesh Box(const glm::dvec3& low, const glm::dvec3& high) {
  SurfaceMesh box;
  for (int i = 0; i < 8; ++i)
    box.vertices.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return box;
}

// An octahedron whose triangles are cut in four `levels` times: 8 * 4^levels triangles.
inline SurfaceMesh Sphere(const glm::dvec3& centre, double radius, int levels) {
  SurfaceMesh sphere{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(sphere.vertices.size()));
      if (is_new)
        sphere.vertices.push_back(glm::normalize(sphere.vertices[a] + sphere.vertices[b]));
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const std::array<int, 3>& part : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                             std::array{ca, bc, c}, std::array{ab, bc, ca}})
        finer.push_back(part);
    }
    sphere.triangles = std::move(finer);
  }
  for (glm::dvec3& x : sphere.vertices) x = centre + radius * x;
  return sphere;
}

// A ring about z, `along` x `around` quads cut in two.
inline SurfaceMesh Torus(double ring_radius, double tube_radius, int along, int around) {
  SurfaceMesh torus;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      const double u = 2 * std::numbers::pi * i / along, v = 2 * std::numbers::pi * j / around;
      const double r = ring_radius + tube_radius * std::cos(v);
      torus.vertices.push_back({r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return (i % along) * around + j % around; };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return torus;
}

// Both, unconnected.
inline SurfaceMesh Together(SurfaceMesh first, const SurfaceMesh& second) {
  const int offset = static_cast<int>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const auto& [a, b, c] : second.triangles)
    first.triangles.push_back({a + offset, b + offset, c + offset});
  return first;
}

inline SurfaceMesh InsideOut(SurfaceMesh surface) {
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

}  // namespace arthro::test
