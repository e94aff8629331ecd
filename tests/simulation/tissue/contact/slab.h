// Slab of tissue, by default 20 × 20 × 6 mm with its top at z = 0: mesh, fine skin, field. Curved
// meshes are slabs with a smooth bend in their rest shape. m.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "tests/support/tissue/tissue_meshes.h"

namespace arthro::test {

inline constexpr glm::dvec3 kSlabLow{-0.01, -0.01, -0.006}, kSlabHigh{0.01, 0.01, 0.0};

inline TetMesh SlabMesh(int order, const Cells& cells = {6, 6, 3}, const glm::dvec3& low = kSlabLow,
                        const glm::dvec3& high = kSlabHigh) {
  return GridMesh(order,
                  {EvenTicks(low.x, high.x, cells[0]), EvenTicks(low.y, high.y, cells[1]),
                   EvenTicks(low.z, high.z, cells[2])},
                  [](const glm::dvec3& p) { return p; });
}

// Bends the slab upwards by 2 mm in the middle, as a paraboloid. T10 represents it exactly along x
// and y, so only the curved map is tested.
inline glm::dvec3 Bent(const glm::dvec3& p) {
  return {p.x, p.y, p.z + 0.002 - 10.0 * (p.x * p.x + p.y * p.y)};
}

inline TetMesh BentMesh(const Cells& cells = {4, 4, 2}) {
  return GridMesh(
      2,
      {EvenTicks(kSlabLow.x, kSlabHigh.x, cells[0]), EvenTicks(kSlabLow.y, kSlabHigh.y, cells[1]),
       EvenTicks(kSlabLow.z, kSlabHigh.z, cells[2])},
      Bent);
}

// Surface of a box with squares of about `size`, each split in two, facing outwards.
inline SurfaceMesh SlabSkin(double size = 5e-4, const glm::dvec3& low = kSlabLow,
                            const glm::dvec3& high = kSlabHigh) {
  SurfaceMesh skin;
  const glm::dvec3 extent = high - low;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const int nu = std::max(1, static_cast<int>(std::lround(extent[u] / size)));
      const int nv = std::max(1, static_cast<int>(std::lround(extent[v] / size)));
      const int first = static_cast<int>(skin.vertices.size());
      for (int i = 0; i <= nu; ++i)
        for (int j = 0; j <= nv; ++j) {
          glm::dvec3 x;
          x[axis] = side == 1 ? high[axis] : low[axis];
          x[u] = low[u] + extent[u] * i / nu;
          x[v] = low[v] + extent[v] * j / nv;
          skin.vertices.push_back(x);
        }
      for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
          const int a = first + i * (nv + 1) + j, b = a + nv + 1;
          std::array<int, 3> one{a, b, b + 1}, two{a, b + 1, a + 1};
          if (side == 0) std::swap(one[1], one[2]), std::swap(two[1], two[2]);
          skin.triangles.push_back(one);
          skin.triangles.push_back(two);
        }
    }
  return skin;
}

// Signed distance to a box, negative inside.
inline double BoxDistance(const glm::dvec3& x, const glm::dvec3& low = kSlabLow,
                          const glm::dvec3& high = kSlabHigh) {
  const glm::dvec3 d = glm::abs(x - 0.5 * (low + high)) - 0.5 * (high - low);
  return glm::length(glm::max(d, glm::dvec3(0.0))) + std::min(std::max({d.x, d.y, d.z}), 0.0);
}

}  // namespace arthro::test
