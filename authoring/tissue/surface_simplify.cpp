#include "authoring/tissue/surface_simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro::authoring {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

// A collapse may turn a triangle by this at most.
constexpr float kMostTurn = 60.0f;  // deg

double DistanceToSegment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(x - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(x, a + t * along);
}

double DistanceToSurface(const glm::dvec3& x, const SurfaceMesh& surface) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [i, j, k] : surface.triangles) {
    const glm::dvec3 &a = surface.vertices[i], &b = surface.vertices[j], &c = surface.vertices[k];
    // The box is a bound that spares most triangles the rest.
    const glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    if (glm::distance(x, glm::clamp(x, low, high)) >= nearest) continue;
    nearest = std::min(nearest, DistanceToTriangle(x, a, b, c));
  }
  return nearest;
}

}  // namespace

double DistanceToTriangle(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  const auto is_inside_of = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, x - from), normal) >= 0;
  };
  if (length > 0 && is_inside_of(a, b) && is_inside_of(b, c) && is_inside_of(c, a))
    return std::abs(glm::dot(normal, x - a)) / length;
  return std::min(
      {DistanceToSegment(x, a, b), DistanceToSegment(x, b, c), DistanceToSegment(x, c, a)});
}

Simplification SimplifySurface(SurfaceMesh& surface, int most_triangles) {
  Simplification result;
  result.triangles_before = result.triangles_after = static_cast<int>(surface.triangles.size());
  if (result.triangles_before <= most_triangles) return result;

  Mesh mesh;
  OpenMesh::VPropHandleT<int> source;
  mesh.add_property(source);
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    // In millimetres: the decimater orders edges by squared errors in 32 bits.
    const glm::dvec3 x = 1e3 * surface.vertices[i];
    const auto vertex = mesh.add_vertex({x.x, x.y, x.z});
    mesh.property(source, vertex) = static_cast<int>(i);
  }
  for (const auto& [a, b, c] : surface.triangles)
    mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c));
  mesh.request_face_normals();
  mesh.update_face_normals();

  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle no_folds;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.add(no_folds);
  decimater.module(no_folds).set_max_normal_deviation(kMostTurn);
  decimater.initialize();
  decimater.decimate_to_faces(0, static_cast<std::size_t>(most_triangles));
  mesh.garbage_collection();

  SurfaceMesh simple;
  std::vector<char> stays(surface.vertices.size(), false);
  for (const auto vertex : mesh.vertices()) {
    stays[mesh.property(source, vertex)] = true;
    simple.vertices.push_back(surface.vertices[mesh.property(source, vertex)]);
  }
  for (const auto face : mesh.faces()) {
    std::array<int, 3> triangle{};
    int corner = 0;
    for (const auto vertex : mesh.fv_range(face)) triangle[corner++] = vertex.idx();
    simple.triangles.push_back(triangle);
  }
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
    if (!stays[i])
      result.largest_distance =
          std::max(result.largest_distance, DistanceToSurface(surface.vertices[i], simple));
  result.triangles_after = static_cast<int>(simple.triangles.size());
  surface = std::move(simple);
  return result;
}

}  // namespace arthro::authoring
