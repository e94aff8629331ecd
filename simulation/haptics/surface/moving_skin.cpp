#include "simulation/haptics/surface/moving_skin.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::simulation {

MovingSkin::MovingSkin(const SurfaceMesh& surface)
    : triangles_(surface.triangles.begin(), surface.triangles.end()),
      vertices_(surface.vertices.begin(), surface.vertices.end()) {
  std::vector<Box3> boxes(triangles_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    boxes[i] = BoxOf(CornersOfTriangle(static_cast<int>(i)));
  tree_ = BoxTree(boxes);
}

TriangleCorners MovingSkin::CornersOfTriangle(int triangle) const noexcept {
  const auto& corner = triangles_[static_cast<std::size_t>(triangle)];
  return {vertices_[static_cast<std::size_t>(corner[0])],
          vertices_[static_cast<std::size_t>(corner[1])],
          vertices_[static_cast<std::size_t>(corner[2])]};
}

void MovingSkin::Move(std::span<const glm::dvec3> positions) noexcept {
  std::copy_n(positions.begin(), std::min(positions.size(), vertices_.size()), vertices_.begin());
  if (!tree_.empty()) tree_.Refit([&](int i) noexcept { return BoxOf(CornersOfTriangle(i)); });
}

bool MovingSkin::Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
                       SweepHit& hit) const noexcept {
  const glm::dvec3 motion = to - from;
  bool found = false;
  const auto test = [&](int i) noexcept {
    const TriangleCorners corner = CornersOfTriangle(i);
    const glm::dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double area = glm::length(across);
    if (!(area > 0.0) || !SweepTriangle(corner, across / area, from, motion, radius, hit)) return;
    hit.triangle = i;
    found = true;
  };
  if (first >= 0 && first < static_cast<int>(triangles_.size())) test(first);
  const glm::dvec3 end = from + hit.fraction * motion;
  double limit2 = radius * radius;
  tree_.ForNear(Box3{glm::min(from, end), glm::max(from, end)}, limit2, test);
  return found;
}

bool MovingSkin::IsCrossed(const Segment3& segment) const noexcept {
  double limit2 = 0.0;
  tree_.ForNear(segment, limit2, [&](int i) noexcept {
    if (Crosses(segment, CornersOfTriangle(i))) limit2 = -1.0;
  });
  return limit2 < 0.0;
}

bool MovingSkin::IsFree(const glm::dvec3& x, double radius) const noexcept {
  return WayOut(x, radius) == glm::dvec3(0.0);
}

glm::dvec3 MovingSkin::WayOut(const glm::dvec3& x, double radius) const noexcept {
  double limit2 = radius * radius;
  glm::dvec3 nearest(0.0), normal(0.0);
  int count = 0;
  // Triangles that share the nearest edge or corner tell the side by the sum of their normals.
  constexpr double kSame = 1e-9;  // share of the squared distance
  tree_.ForNear(x, limit2, [&](int i) noexcept {
    const TriangleCorners corner = CornersOfTriangle(i);
    const glm::dvec3 at = PointOn(corner, ClosestOnTriangle(corner, x));
    const glm::dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double distance2 = glm::dot(x - at, x - at), area = glm::length(across);
    if (!(area > 0.0) || distance2 > limit2 * (1.0 + kSame)) return;
    const bool is_same = count > 0 && distance2 >= limit2 * (1.0 - kSame);
    normal = is_same ? normal + across / area : across / area;
    if (!is_same) nearest = at;
    limit2 = std::min(limit2, distance2);
    ++count;
  });
  const double length = glm::length(normal);
  if (count == 0 || !(length > 0.0)) return glm::dvec3(0.0);
  const glm::dvec3 off = x - nearest, outward = normal / length;
  const double distance = glm::length(off);
  if (glm::dot(off, outward) < 0.0 || !(distance > 0.0))
    return (distance + radius) * (distance > 0.0 ? -off / distance : outward);
  return distance < radius ? (radius - distance) * (off / distance) : glm::dvec3(0.0);
}

}  // namespace arthro::simulation
