#include "authoring/tissue/tetrahedra/pull_middles.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "authoring/tissue/tetrahedra/tet_quality.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::authoring {
namespace {

glm::dvec3 NearestOnSegment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(x - a, along) / square, 0.0, 1.0) : 0.0;
  return a + t * along;
}

// Returns the point of a triangle that is nearest to x. Projects along the normal, which rounds
// less often than the barycentric coordinates of ClosestOnTriangle (3.5e-18 m between the two): a
// mesh keeps its bytes from version to version.
glm::dvec3 FootOn(const TriangleCorners& corner, const glm::dvec3& x) {
  const auto& [a, b, c] = corner;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  const auto is_inside_of = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, x - from), normal) >= 0;
  };
  if (square > 0 && is_inside_of(a, b) && is_inside_of(b, c) && is_inside_of(c, a))
    return x - glm::dot(normal, x - a) / square * normal;
  glm::dvec3 nearest = NearestOnSegment(x, a, b);
  for (const glm::dvec3& place : {NearestOnSegment(x, b, c), NearestOnSegment(x, c, a)})
    if (glm::distance(x, place) < glm::distance(x, nearest)) nearest = place;
  return nearest;
}

glm::dvec3 FootOn(const SurfaceMesh& surface, const glm::dvec3& x) {
  glm::dvec3 nearest = x;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const TriangleCorners corner = CornersOf(surface, t);
    if (Distance2(BoxOf(corner), x) > best * best) continue;
    const glm::dvec3 place = FootOn(corner, x);
    if (const double distance = glm::distance(x, place); distance < best) {
      best = distance;
      nearest = place;
    }
  }
  return nearest;
}

}  // namespace

PulledMiddles PullMiddles(TetMesh& mesh, const SurfaceMesh& fine, const Progress& progress) {
  PulledMiddles result;
  if (mesh.order != 2) return result;
  const std::vector<std::uint8_t> is_outside = SurfaceNodes(mesh);
  // Elements that each middle belongs to.
  std::vector<std::vector<int>> elements(mesh.rest_positions.size());
  for (int e = 0; e < mesh.ElementCount(); ++e)
    for (int k = 4; k < 10; ++k)
      elements[static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(e) * 10 + k])]
          .push_back(e);
  const auto is_sound = [&](std::size_t node) {
    return std::all_of(elements[node].begin(), elements[node].end(),
                       [&](int e) { return JacobianShare(mesh, e) >= kLeastJacobian; });
  };
  // A middle that its neighbours held back may go farther once they have moved.
  struct Middle {
    std::size_t node;
    glm::dvec3 straight, move;
    double share = 0;
  };
  std::vector<Middle> middles;
  for (std::size_t node = 0; node < elements.size(); ++node)
    if (!elements[node].empty() && is_outside[node]) {
      progress.Step("curving the elements",
                    static_cast<double>(node) / static_cast<double>(elements.size()));
      const glm::dvec3 straight = mesh.rest_positions[node];
      middles.push_back({node, straight, FootOn(fine, straight) - straight});
    }
  for (int sweep = 0; sweep < 3; ++sweep)
    for (Middle& middle : middles)
      for (double share = 1.0; share > middle.share && share > 0.1; share -= 0.125) {
        mesh.rest_positions[middle.node] = middle.straight + share * middle.move;
        if (is_sound(middle.node)) {
          middle.share = share;
          break;
        }
        mesh.rest_positions[middle.node] = middle.straight + middle.share * middle.move;
      }
  for (const Middle& middle : middles) {
    ++(middle.share == 1.0 ? result.pulled : result.held_back);
    result.largest_move = std::max(result.largest_move, middle.share * glm::length(middle.move));
  }
  return result;
}

}  // namespace arthro::authoring
