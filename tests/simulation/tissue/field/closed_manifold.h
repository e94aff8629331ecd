// Checks whether a triangle surface is a closed, consistently oriented manifold, and computes its
// volume.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::test {

struct SurfaceFaults {
  int edges = 0;     // directed edges that do not occur exactly once with their opposite
  int vertices = 0;  // vertices whose triangles are not one closed fan
};

inline SurfaceFaults FaultsOf(const SurfaceMesh& surface) {
  SurfaceFaults faults;
  std::map<std::pair<int, int>, int> uses;
  std::vector<std::map<int, int>> next(surface.vertices.size());  // next vertex around each vertex
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++uses[{t[i], t[(i + 1) % 3]}];
      next[static_cast<std::size_t>(t[i])][t[(i + 1) % 3]] = t[(i + 2) % 3];
    }
  for (const auto& [edge, count] : uses)
    faults.edges += count != 1 || !uses.contains({edge.second, edge.first});
  for (const auto& fan : next) {
    if (fan.empty()) {
      ++faults.vertices;
      continue;
    }
    std::size_t steps = 0;
    int at = fan.begin()->first;
    do {
      const auto step = fan.find(at);
      if (step == fan.end()) break;
      at = step->second;
      ++steps;
    } while (at != fan.begin()->first && steps <= fan.size());
    faults.vertices += steps != fan.size();
  }
  return faults;
}

inline double EnclosedVolume(const SurfaceMesh& surface) {
  double six = 0;
  const auto at = [&](int i) { return surface.vertices[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b, c] : surface.triangles) six += glm::dot(at(a), glm::cross(at(b), at(c)));
  return six / 6.0;
}

}  // namespace arthro::test
