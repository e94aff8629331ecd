// Fine surface carried by a coarse tetrahedral mesh: each vertex is a point of one element and
// moves by its shape functions. It is both drawn and touched. Mesh's own frame, m.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "simulation/core/geometry/box_tree.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::simulation {

// Point of the tissue: its element and the shape-function values there (4 or 10).
struct EmbeddedPoint {
  int element = -1;
  std::array<double, 10> weight{};
};

// Finds the element that contains a rest position (including curved T10). A point outside gets the
// nearest element and weights that extrapolate linearly from its nearest point. These weights
// reproduce the point at rest and every affine motion of it exactly. Built once per mesh, which it
// copies.
class ElementFinder {
 public:
  explicit ElementFinder(const TetMesh& mesh);
  EmbeddedPoint Find(const glm::dvec3& rest) const noexcept;
  // Resolves elements that overlap at rest, such as the copies made by a cut: of the elements that
  // contain the point, picks the one with most nodes in common with the elements `beside`.
  EmbeddedPoint FindBeside(const glm::dvec3& rest, std::span<const int> beside) const noexcept;
  // Picks the element among these that contains the point or is nearest; the first of equals.
  EmbeddedPoint FindAmong(const glm::dvec3& rest, std::span<const int> elements) const noexcept;
  // Finds the tissue at this place in the deformed mesh `x`, and its rest position. Returns false
  // outside all elements. Requires Refit after x has changed.
  void Refit(std::span<const glm::dvec3> x) noexcept;
  bool FindDeformed(const glm::dvec3& place, EmbeddedPoint& point, glm::dvec3& rest) const noexcept;
  // The same with the deformation gradient ∂x/∂X.
  bool FindDeformed(const glm::dvec3& place, EmbeddedPoint& point, glm::dvec3& rest,
                    glm::dmat3& gradient) const noexcept;
  // Returns the position of a point at the last Refit.
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
  double inside2_ = 0;  // m²; a smaller squared distance counts as inside
  BoxTree rest_tree_, tree_;
};

struct EmbeddedSkin {
  SurfaceMesh rest;
  std::vector<EmbeddedPoint> point;  // one per vertex
};

// Returns the position of a point for nodes at `x`.
glm::dvec3 PlaceOf(const EmbeddedPoint& point, std::span<const int> nodes,
                   std::span<const glm::dvec3> x) noexcept;

// Throws Error(kBadMesh) for a mesh without elements.
EmbeddedSkin EmbedSkin(SurfaceMesh surface, const TetMesh& mesh, const ElementFinder& finder);

// Computes vertex positions and unit normals (area-weighted, smooth) of the skin for nodes at `x`.
void DeformSkin(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
                std::span<glm::dvec3> positions, std::span<glm::dvec3> normals) noexcept;

}  // namespace arthro::simulation
