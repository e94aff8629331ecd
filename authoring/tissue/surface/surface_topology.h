// Edges and connected components of a triangle surface, from a sorted list of sides. Surfaces are
// checked and repaired with it before they are known to be manifold, which OpenMesh's half-edges
// require: its add_face refuses a third triangle at an edge and a neighbour that faces the other
// way, so such faults could not be counted, placed or mended. OpenMesh simplifies surfaces
// afterwards (surface_simplify.h).
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::authoring {

// One side of one triangle. `a` < `b`; forward when the triangle runs from a to b.
struct EdgeUse {
  int a, b, triangle;
  bool forward;
};

// Returns all sides; those of one edge are adjacent.
std::vector<EdgeUse> SortedEdgeUses(const SurfaceMesh& surface);

// Calls `visit(first, last)` for each edge with the range of its uses.
template <class F>
void ForEachEdge(const std::vector<EdgeUse>& uses, F&& visit) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first;
    while (last != uses.end() && last->a == first->a && last->b == first->b) ++last;
    visit(first, last);
    first = last;
  }
}

// Returns a number from 0 for each triangle, equal for triangles that share an edge, in the order
// of the components' first triangles.
std::vector<int> ComponentOfTriangles(const SurfaceMesh& surface, const std::vector<EdgeUse>& uses,
                                      int* count);

// Disjoint sets over 0 .. n-1; the smallest member represents its set.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(static_cast<std::size_t>(n)) {
    for (int i = 0; i < n; ++i) parent_[i] = i;
  }
  int Find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(int i, int j) {
    i = Find(i), j = Find(j);
    if (i < j)
      parent_[j] = i;
    else
      parent_[i] = j;
  }

 private:
  std::vector<int> parent_;
};

// Returns the volume enclosed by some triangles, by the divergence theorem about the first vertex;
// m³, positive when they face outwards.
double SignedVolume(const std::vector<glm::dvec3>& vertices,
                    const std::vector<std::array<int, 3>>& triangles);

// Returns the winding number of a closed surface around x: 1 inside, 0 outside, -1 inside a surface
// that faces inwards (van Oosterom and Strackee 1983).
double WindingNumber(const std::vector<glm::dvec3>& vertices,
                     const std::vector<std::array<int, 3>>& triangles, const glm::dvec3& x);

// Twice the area over the square of the longest side; a triangle below this counts as a line.
inline constexpr double kNoArea = 1e-12;
bool HasNoArea(const SurfaceMesh& surface, const std::array<int, 3>& triangle);

}  // namespace arthro::authoring
