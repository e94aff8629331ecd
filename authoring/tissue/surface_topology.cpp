#include "authoring/tissue/surface_topology.h"

#include <algorithm>
#include <tuple>

#include <glm/geometric.hpp>

namespace arthro::authoring {

std::vector<EdgeUse> SortedEdgeUses(const SurfaceMesh& surface) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int side = 0; side < 3; ++side) {
      const int from = surface.triangles[t][side], to = surface.triangles[t][(side + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t), from < to});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
    return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
  });
  return uses;
}

std::vector<int> ComponentOfTriangles(const SurfaceMesh& surface, const std::vector<EdgeUse>& uses,
                                      int* count) {
  const int n = static_cast<int>(surface.triangles.size());
  DisjointSets sets(n);
  ForEachEdge(uses, [&](auto first, auto last) {
    for (auto use = first; use != last; ++use) sets.Join(first->triangle, use->triangle);
  });
  std::vector<int> number(static_cast<std::size_t>(n), -1);
  *count = 0;
  for (int t = 0; t < n; ++t) {
    const int root = sets.Find(t);  // never after t
    number[t] = root == t ? (*count)++ : number[root];
  }
  return number;
}

double SignedVolume(const std::vector<glm::dvec3>& vertices,
                    const std::vector<std::array<int, 3>>& triangles) {
  if (vertices.empty()) return 0.0;
  const glm::dvec3 origin = vertices[0];
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : triangles)
    six_volumes +=
        glm::dot(vertices[a] - origin, glm::cross(vertices[b] - origin, vertices[c] - origin));
  return six_volumes / 6.0;
}

}  // namespace arthro::authoring
