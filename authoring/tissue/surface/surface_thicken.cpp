#include "authoring/tissue/surface/surface_thicken.h"

#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "authoring/tissue/surface/surface_topology.h"

namespace arthro::authoring {
namespace {

// Means of the normals around each vertex, weighted by the angle there, so that they do not depend
// on the triangulation.
std::vector<glm::dvec3> VertexNormals(const SurfaceMesh& surface) {
  std::vector<glm::dvec3> normals(surface.vertices.size(), glm::dvec3(0.0));
  for (const auto& triangle : surface.triangles)
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 corner = surface.vertices[triangle[i]];
      const glm::dvec3 u = surface.vertices[triangle[(i + 1) % 3]] - corner;
      const glm::dvec3 v = surface.vertices[triangle[(i + 2) % 3]] - corner;
      const glm::dvec3 cross = glm::cross(u, v);
      const double sine = glm::length(cross);
      if (sine > 0) normals[triangle[i]] += cross / sine * std::atan2(sine, glm::dot(u, v));
    }
  for (glm::dvec3& normal : normals)
    if (const double length = glm::length(normal); length > 0) normal /= length;
  return normals;
}

}  // namespace

int ThickenOpenParts(RepairedSurface& repaired, double thickness) {
  SurfaceMesh& surface = repaired.surface;
  const auto uses = SortedEdgeUses(surface);
  int count = 0;
  const auto component_of = ComponentOfTriangles(surface, uses, &count);
  std::set<int> open;
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first == 1) open.insert(component_of[first->triangle]);
  });
  if (open.empty()) return 0;

  // Vertices of open parts get a copy behind them. The triangles' own side is the outer one, so a
  // negative thickness makes the copy the front.
  const auto normals = VertexNormals(surface);
  const int triangles = static_cast<int>(surface.triangles.size());
  std::vector<int> partner(surface.vertices.size(), -1);
  const auto partner_of = [&](int vertex) {
    if (partner[vertex] < 0) {
      partner[vertex] = static_cast<int>(surface.vertices.size());
      surface.vertices.push_back(surface.vertices[vertex] - thickness * normals[vertex]);
    }
    return partner[vertex];
  };
  const auto add = [&](std::array<int, 3> triangle) {
    surface.triangles.push_back(triangle);
    repaired.source_triangle.push_back(-1);
  };
  for (int t = 0; t < triangles; ++t) {
    if (!open.contains(component_of[t])) continue;
    const auto [a, b, c] = surface.triangles[t];
    add({partner_of(a), partner_of(c), partner_of(b)});
  }
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first != 1) return;
    const int a = first->forward ? first->a : first->b, b = first->forward ? first->b : first->a;
    add({b, a, partner_of(a)});
    add({b, partner_of(a), partner_of(b)});
  });
  if (thickness < 0)
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (t >= static_cast<std::size_t>(triangles) || open.contains(component_of[t]))
        std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  return static_cast<int>(open.size());
}

}  // namespace arthro::authoring
