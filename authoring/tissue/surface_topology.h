// Which triangles meet at which edge, and which hang together. Deterministic: sorted, not hashed.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/surface_mesh.h"

namespace arthro::authoring {

// One side of one triangle. `a` < `b`; forward when the triangle runs from a to b.
struct EdgeUse {
  int a, b, triangle;
  bool forward;
};

// All sides, those of one edge beside one another.
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

// A number from 0 for each triangle; triangles that share an edge have the same one. Numbered in
// the order of their first triangle.
std::vector<int> ComponentOfTriangles(const SurfaceMesh& surface, const std::vector<EdgeUse>& uses,
                                      int* count);

// Disjoint sets over 0 .. n-1; the smallest member stands for its set.
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

// Volume enclosed by some triangles, by the divergence theorem about the first vertex; m³, positive
// when they face outwards.
double SignedVolume(const std::vector<glm::dvec3>& vertices,
                    const std::vector<std::array<int, 3>>& triangles);

}  // namespace arthro::authoring
