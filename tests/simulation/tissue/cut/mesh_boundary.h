// Boundary faces of a tetrahedral mesh as a closed surface; a quadratic face becomes four
// triangles.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::test {

inline SurfaceMesh BoundaryOf(const TetMesh& mesh) {
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 6>>> faces;
  const int n = mesh.NodesPerElement();
  for (int e = 0; e < mesh.ElementCount(); ++e)
    for (const auto& local : simulation::kTetFaces) {
      std::array<int, 6> face{};
      for (std::size_t i = 0; i < (mesh.order == 2 ? 6u : 3u); ++i)
        face[i] = mesh.elements[static_cast<std::size_t>(e * n + local[i])];
      std::array<int, 3> key{face[0], face[1], face[2]};
      std::sort(key.begin(), key.end());
      auto& entry = faces[key];
      ++entry.first;
      entry.second = face;
    }
  SurfaceMesh surface{mesh.rest_positions, {}};
  for (const auto& [key, entry] : faces) {
    if (entry.first != 1) continue;
    const auto& f = entry.second;
    if (mesh.order == 1)
      surface.triangles.push_back({f[0], f[1], f[2]});
    else
      for (const std::array<int, 3>& t :
           {std::array{f[0], f[3], f[5]}, std::array{f[3], f[1], f[4]},
            std::array{f[5], f[4], f[2]}, std::array{f[3], f[4], f[5]}})
        surface.triangles.push_back(t);
  }
  // Keeps only the boundary vertices, in mesh order, since a skin is moved vertex by vertex.
  std::vector<int> number(surface.vertices.size(), -1);
  for (const auto& triangle : surface.triangles)
    for (const int v : triangle) number[static_cast<std::size_t>(v)] = 0;
  int count = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      surface.vertices[static_cast<std::size_t>(count)] = surface.vertices[v];
      number[v] = count++;
    }
  surface.vertices.resize(static_cast<std::size_t>(count));
  for (auto& triangle : surface.triangles)
    for (int& v : triangle) v = number[static_cast<std::size_t>(v)];
  return surface;
}

}  // namespace arthro::test
