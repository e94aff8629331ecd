// A fine surface carried by a coarse tetrahedral mesh: each vertex is a point of one element, moved
// by its shape functions. What is drawn and what is touched. Mesh's own frame, m.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/surface_mesh.h"
#include "simulation/scene/tet_mesh.h"

namespace arthro::simulation {

// A point of the tissue: rest place, element and shape-function values there (4 or 10 of them).
struct EmbeddedPoint {
  int element = -1;
  std::array<double, 10> weight{};
};

// Finds the element in which a rest position lies (curved T10 included); a point slightly outside
// gets the nearest element and the weights of its extrapolation. Built once a mesh.
class ElementFinder {
 public:
  explicit ElementFinder(const TetMesh& mesh);
  EmbeddedPoint Find(const glm::dvec3& rest) const;
  // The same in the deformed mesh `x`: which tissue is at this place now, and its rest position.
  // False: outside all elements. noexcept, allocates nothing. Refit first when x has changed.
  void Refit(std::span<const glm::dvec3> x) noexcept;
  bool FindDeformed(const glm::dvec3& place, EmbeddedPoint& point, glm::dvec3& rest) const noexcept;

 private:
  // (the implementer's)
};

struct EmbeddedSkin {
  SurfaceMesh rest;
  std::vector<EmbeddedPoint> point;  // one a vertex
};

EmbeddedSkin EmbedSkin(SurfaceMesh surface, const TetMesh& mesh, const ElementFinder& finder);

// Vertex positions and unit normals (area-weighted, smooth) of the skin when nodes are at `x`.
void DeformSkin(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
                std::span<glm::dvec3> positions, std::span<glm::dvec3> normals) noexcept;

}  // namespace arthro::simulation
