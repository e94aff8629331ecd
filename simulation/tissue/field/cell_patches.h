// Topology of the surface in one grid cell: the patch to which each crossed edge belongs.
//
// Corner c stands at (c & 1, c >> 1 & 1, c >> 2 & 1); a configuration has bit c set where corner c
// is solid. Edge 4 a + m runs along axis a; the bits of m are its positions on the axes after a.
// Face 2 a + s is the side of axis a at s.
//
// Two solid corners at the ends of a face's diagonal are separated, so connectivity is that along
// grid edges. One exception keeps the surface a manifold. Where the patches on both sides of such a
// face would touch themselves across it, the face is `joined` instead (as in Wenger, Isosurfaces,
// 3.3); in both cells the corners are connected anyway.
#pragma once

#include <array>
#include <cstdint>

namespace arthro::simulation {

struct CellPatches {
  std::array<std::int8_t, 12> of_edge{};  // patch of each edge; −1: not crossed
  int count = 0;
};

constexpr int LowCornerOfEdge(int edge) {
  const int a = edge / 4, u = (a + 1) % 3, v = (a + 2) % 3;
  return (edge & 1) << u | (edge >> 1 & 1) << v;
}
constexpr bool IsCrossed(int configuration, int edge) {
  const int low = LowCornerOfEdge(edge), high = low | 1 << edge / 4;
  return ((configuration >> low ^ configuration >> high) & 1) != 0;
}
// Returns the edge between two corners that differ in one axis.
constexpr int EdgeBetween(int c, int d) {
  const int axis = (c ^ d) == 1 ? 0 : (c ^ d) == 2 ? 1 : 2;
  const int low = c & d;
  return 4 * axis + (low >> (axis + 1) % 3 & 1) + 2 * (low >> (axis + 2) % 3 & 1);
}
// Returns the corners of a face in cyclic order.
constexpr std::array<int, 4> CornersOfFace(int face) {
  const int a = face / 2, u = 1 << (a + 1) % 3, v = 1 << (a + 2) % 3, base = (face & 1) << a;
  return {base, base | u, base | u | v, base | v};
}
constexpr bool IsAmbiguous(int configuration, int face) {
  const auto c = CornersOfFace(face);
  const auto solid = [&](std::size_t i) { return (configuration >> c[i] & 1) != 0; };
  return solid(0) == solid(2) && solid(1) == solid(3) && solid(0) != solid(1);
}

// `joined` has bit f set for face f.
constexpr CellPatches FindPatches(int configuration, int joined) {
  std::array<int, 12> root{};
  for (int e = 0; e < 12; ++e) root[static_cast<std::size_t>(e)] = e;
  const auto find = [&](int e) {
    while (root[static_cast<std::size_t>(e)] != e) e = root[static_cast<std::size_t>(e)];
    return e;
  };
  const auto link = [&](int e, int f) {
    const int a = find(e), b = find(f);
    root[static_cast<std::size_t>(a > b ? a : b)] = a > b ? b : a;
  };
  for (int face = 0; face < 6; ++face) {
    const auto c = CornersOfFace(face);
    if (IsAmbiguous(configuration, face)) {
      // Connects the two edges at each corner of the kind that is cut off.
      const bool cut_off_solid = (joined >> face & 1) == 0;
      for (std::size_t i = 0; i < 4; ++i)
        if (((configuration >> c[i] & 1) != 0) == cut_off_solid)
          link(EdgeBetween(c[i], c[(i + 1) % 4]), EdgeBetween(c[i], c[(i + 3) % 4]));
      continue;
    }
    int first = -1;
    for (std::size_t i = 0; i < 4; ++i) {
      const int edge = EdgeBetween(c[i], c[(i + 1) % 4]);
      if (!IsCrossed(configuration, edge)) continue;
      if (first < 0)
        first = edge;
      else
        link(first, edge);
    }
  }
  CellPatches patches;
  for (int e = 0; e < 12; ++e) {
    auto& patch = patches.of_edge[static_cast<std::size_t>(e)];
    patch = -1;
    if (!IsCrossed(configuration, e)) continue;
    const int r = find(e);  // the lowest edge of the patch, which is numbered already
    patch = r == e ? static_cast<std::int8_t>(patches.count++)
                   : patches.of_edge[static_cast<std::size_t>(r)];
  }
  return patches;
}

// Returns the faces across which a patch touches itself while solid corners are separated; bit f
// stands for face f.
constexpr int SelfTouchingFaces(int configuration) {
  const CellPatches patches = FindPatches(configuration, 0);
  int faces = 0;
  for (int face = 0; face < 6; ++face) {
    if (!IsAmbiguous(configuration, face)) continue;
    const auto c = CornersOfFace(face);
    const auto patch = [&](std::size_t i) {
      return patches.of_edge[static_cast<std::size_t>(EdgeBetween(c[i], c[(i + 1) % 4]))];
    };
    if (patch(0) == patch(1) && patch(1) == patch(2)) faces |= 1 << face;
  }
  return faces;
}

}  // namespace arthro::simulation
