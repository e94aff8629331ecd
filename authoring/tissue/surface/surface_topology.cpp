#include "authoring/tissue/surface/surface_topology.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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
    const int root = sets.Find(t);  // at most t
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

double WindingNumber(const std::vector<glm::dvec3>& vertices,
                     const std::vector<std::array<int, 3>>& triangles, const glm::dvec3& x) {
  double half_angle = 0;
  for (const auto& [i, j, k] : triangles) {
    const glm::dvec3 a = vertices[i] - x, b = vertices[j] - x, c = vertices[k] - x;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    half_angle +=
        std::atan2(glm::dot(a, glm::cross(b, c)),
                   la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return half_angle / (2.0 * std::numbers::pi);
}

bool HasNoArea(const SurfaceMesh& surface, const std::array<int, 3>& triangle) {
  const glm::dvec3 &x = surface.vertices[triangle[0]], &y = surface.vertices[triangle[1]],
                   &z = surface.vertices[triangle[2]];
  const double longest = std::max({glm::distance(x, y), glm::distance(y, z), glm::distance(z, x)});
  return glm::length(glm::cross(y - x, z - x)) <= kNoArea * longest * longest;
}

}  // namespace arthro::authoring
