#include "simulation/scene/mesh/surface_finder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro {

Box3 BoxOf(const TriangleCorners& corner) noexcept {
  return {glm::min(corner[0], glm::min(corner[1], corner[2])),
          glm::max(corner[0], glm::max(corner[1], corner[2]))};
}

TriangleCorners CornersOf(const SurfaceMesh& surface, std::size_t triangle) noexcept {
  const auto& [a, b, c] = surface.triangles[triangle];
  const auto at = [&](int i) { return surface.vertices[static_cast<std::size_t>(i)]; };
  return {at(a), at(b), at(c)};
}

SurfaceFinder::SurfaceFinder(const SurfaceMesh& surface) {
  std::vector<Box3> boxes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    triangles_.push_back(CornersOf(surface, t));
    boxes.push_back(BoxOf(triangles_.back()));
  }
  tree_ = BoxTree(boxes);
}

SurfacePoint SurfaceFinder::Find(const glm::dvec3& x, double reach) const noexcept {
  SurfacePoint nearest;
  double least2 = reach * reach;
  tree_.ForNear(x, least2, [&](int triangle) {
    const TriangleCorners& corner = triangles_[static_cast<std::size_t>(triangle)];
    const glm::dvec3 at = ClosestOnTriangle(corner, x), place = PointOn(corner, at);
    const glm::dvec3 way = place - x;
    if (const double distance2 = glm::dot(way, way); distance2 < least2)
      least2 = distance2, nearest = {triangle, at, place};
  });
  return nearest;
}

glm::dvec3 SurfaceFinder::Nearest(const glm::dvec3& x, double reach) const noexcept {
  const SurfacePoint nearest = Find(x, reach);
  return nearest.triangle < 0 ? x : nearest.place;
}

}  // namespace arthro
