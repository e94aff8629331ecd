// A block of cubes of 5 mm, of six tetrahedra each; its sets "fixed" and "end" are its ends.
#pragma once

#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::test {

inline TetMesh TetBlock(int cells) {
  constexpr double kEdge = 0.005;
  TetMesh mesh;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) {
        mesh.rest_positions.push_back(kEdge * glm::dvec3(i, j, k));
        mesh.sets["fixed"].push_back(i == 0);
        mesh.sets["end"].push_back(i == cells);
      }
  constexpr int kPaths[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
  for (int i = 0; i < cells; ++i)
    for (const auto& [a, b] : kPaths) {
      const auto corner = [&](int c) { return ((i + (c >> 2)) * 2 + (c >> 1 & 1)) * 2 + (c & 1); };
      mesh.elements.insert(mesh.elements.end(), {corner(0), corner(b), corner(a), corner(7)});
    }
  return mesh;
}

}  // namespace arthro::test
