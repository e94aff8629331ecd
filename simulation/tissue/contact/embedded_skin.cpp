#include "simulation/tissue/contact/embedded_skin.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/vertex_normals.h"

namespace arthro::simulation {

glm::dvec3 PlaceOf(const EmbeddedPoint& point, std::span<const int> nodes,
                   std::span<const glm::dvec3> x) noexcept {
  glm::dvec3 place(0.0);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    place += point.weight[n] * x[static_cast<std::size_t>(nodes[n])];
  return place;
}

EmbeddedSkin EmbedSkin(SurfaceMesh surface, const TetMesh& mesh, const ElementFinder& finder) {
  if (mesh.ElementCount() == 0)
    throw Error(Code::kBadMesh,
                "a tetrahedral mesh without elements cannot carry a skin; make the mesh again with "
                "`arthroscene tetrahedralize`");
  EmbeddedSkin skin;
  skin.point.reserve(surface.vertices.size());
  for (const glm::dvec3& vertex : surface.vertices) skin.point.push_back(finder.Find(vertex));
  skin.rest = std::move(surface);
  return skin;
}

namespace {

// A compile-time count lets the compiler unroll the sum over nodes.
template <std::size_t kNodes>
void Place(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
           std::span<glm::dvec3> positions) noexcept {
  for (std::size_t v = 0; v < skin.point.size(); ++v) {
    const EmbeddedPoint& point = skin.point[v];
    const int* node = &mesh.elements[static_cast<std::size_t>(point.element) * kNodes];
    glm::dvec3 place(0.0);
    for (std::size_t n = 0; n < kNodes; ++n)
      place += point.weight[n] * x[static_cast<std::size_t>(node[n])];
    positions[v] = place;
  }
}

}  // namespace

void DeformSkin(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
                std::span<glm::dvec3> positions, std::span<glm::dvec3> normals) noexcept {
  if (mesh.order == 2) {
    Place<10>(skin, mesh, x, positions);
  } else {
    Place<4>(skin, mesh, x, positions);
  }
  ComputeVertexNormals(positions, skin.rest.triangles, normals);
}

}  // namespace arthro::simulation
