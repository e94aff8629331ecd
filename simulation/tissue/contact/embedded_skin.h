// A fine surface carried by a coarse tetrahedral mesh: each vertex is a point of one element, moved
// by its shape functions. What is drawn and what is touched. Mesh's own frame, m.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/core/box_tree.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/scene/tet_mesh.h"

namespace arthro::simulation {

// A point of the tissue: rest place, element and shape-function values there (4 or 10 of them).
struct EmbeddedPoint {
  int element = -1;
  std::array<double, 10> weight{};
};

// Finds the element in which a rest position lies (curved T10 included); a point outside gets the
// nearest element and weights that go on linearly from its nearest point, so that they give back
// the point at rest and every affine motion of it exactly. Built once a mesh, which it copies.
class ElementFinder {
 public:
  explicit ElementFinder(const TetMesh& mesh);
  EmbeddedPoint Find(const glm::dvec3& rest) const noexcept;
  // Where elements lie on one another at rest, as the copies that a cut makes: of those that hold
  // the point, the one with most nodes in common with the elements `beside`.
  EmbeddedPoint FindBeside(const glm::dvec3& rest, std::span<const int> beside) const noexcept;
  // In that of these elements which holds it, or is nearest; the first of equals.
  EmbeddedPoint FindAmong(const glm::dvec3& rest, std::span<const int> elements) const noexcept;
  // In the deformed mesh `x`: which tissue is at this place now, and its rest position. False:
  // outside all elements. Refit first when x has changed.
  void Refit(std::span<const glm::dvec3> x) noexcept;
  bool FindDeformed(const glm::dvec3& place, EmbeddedPoint& point, glm::dvec3& rest) const noexcept;
  // The same with the deformation gradient there, ∂x/∂X.
  bool FindDeformed(const glm::dvec3& place, EmbeddedPoint& point, glm::dvec3& rest,
                    glm::dmat3& gradient) const noexcept;
  // Where a point is since the last Refit.
  glm::dvec3 PlaceNow(const EmbeddedPoint& point) const noexcept;

  std::span<const int> NodesOf(int element) const noexcept;

 private:
  struct Local {  // nearest point of an element
    glm::dvec4 l{0.25};
    double distance2 = 0;
  };
  std::array<glm::dvec3, 10> PlacesOf(int element, std::span<const glm::dvec3> x) const noexcept;
  Box3 BoxOf(int element, std::span<const glm::dvec3> x) const noexcept;
  Local Nearest(int element, std::span<const glm::dvec3> x, const glm::dvec3& place) const noexcept;
  bool FindDeformed(const glm::dvec3& place, int& element, Local& local) const noexcept;
  EmbeddedPoint PointAt(int element, const Local& local, const glm::dvec3& rest) const noexcept;
  int CommonNodes(int element, std::span<const int> beside) const noexcept;

  int order_ = 1, nodes_per_element_ = 4;
  std::vector<int> elements_;
  std::vector<glm::dvec3> rest_, x_;
  double inside2_ = 0;  // m², nearer than this is inside
  BoxTree rest_tree_, tree_;
};

struct EmbeddedSkin {
  SurfaceMesh rest;
  std::vector<EmbeddedPoint> point;  // one a vertex
};

// Where a point is when nodes are at `x`.
glm::dvec3 PlaceOf(const EmbeddedPoint& point, std::span<const int> nodes,
                   std::span<const glm::dvec3> x) noexcept;

// Throws Error(kBadMesh) for a mesh without elements.
EmbeddedSkin EmbedSkin(SurfaceMesh surface, const TetMesh& mesh, const ElementFinder& finder);

// Vertex positions and unit normals (area-weighted, smooth) of the skin when nodes are at `x`.
void DeformSkin(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
                std::span<glm::dvec3> positions, std::span<glm::dvec3> normals) noexcept;

}  // namespace arthro::simulation
