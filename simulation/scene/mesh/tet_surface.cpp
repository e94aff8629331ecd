#include "simulation/scene/mesh/tet_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace arthro {
namespace {

// Corners of the faces of an element, seen from outside, and the middles of 01, 12 and 20 of each.
constexpr std::array<std::array<std::size_t, 6>, 4> kFaces{
    {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}}};

}  // namespace

SurfaceMesh SurfaceOf(const TetMesh& mesh) {
  const auto per_element = static_cast<std::size_t>(mesh.NodesPerElement());
  // Faces by their sorted corners; a face that is met again lies inside.
  std::map<std::array<int, 3>, std::optional<std::array<int, 6>>> faces;
  for (std::size_t at = 0; at + per_element <= mesh.elements.size(); at += per_element)
    for (const auto& local : kFaces) {
      std::array<int, 6> face{};
      for (std::size_t i = 0; i < (mesh.order == 2 ? 6u : 3u); ++i)
        face[i] = mesh.elements[at + local[i]];
      std::array<int, 3> corners{face[0], face[1], face[2]};
      std::sort(corners.begin(), corners.end());
      const auto [entry, is_new] = faces.emplace(corners, face);
      if (!is_new) entry->second.reset();
    }
  SurfaceMesh surface;
  for (const auto& [corners, face] : faces) {
    if (!face) continue;
    const auto& [a, b, c, ab, bc, ca] = *face;
    if (mesh.order == 2)
      surface.triangles.insert(surface.triangles.end(),
                               {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    else
      surface.triangles.push_back({a, b, c});
  }
  std::vector<int> vertex_of(mesh.rest_positions.size(), -1);
  for (const auto& triangle : surface.triangles)
    for (const int node : triangle) vertex_of[static_cast<std::size_t>(node)] = 0;
  for (std::size_t node = 0; node < vertex_of.size(); ++node) {
    if (vertex_of[node] < 0) continue;
    vertex_of[node] = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(mesh.rest_positions[node]);
  }
  for (auto& triangle : surface.triangles)
    for (int& node : triangle) node = vertex_of[static_cast<std::size_t>(node)];
  return surface;
}

}  // namespace arthro
