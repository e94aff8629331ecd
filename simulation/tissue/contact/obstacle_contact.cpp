#include "simulation/tissue/contact/obstacle_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

constexpr std::uint8_t kHeld = 7;

// Usable fraction of a large gap, which may be an estimate along a ray instead of the distance.
constexpr double kTrusted = 0.5;

}  // namespace

std::vector<int> SurfaceNodes(const TetMesh& mesh) {
  struct Face {
    std::array<int, 3> corners;  // sorted
    int element, face;
  };
  std::vector<Face> faces;
  faces.reserve(static_cast<std::size_t>(mesh.ElementCount()) * 4);
  const auto node = [&](int element, int local) {
    return mesh.elements[static_cast<std::size_t>(element) *
                             static_cast<std::size_t>(mesh.NodesPerElement()) +
                         static_cast<std::size_t>(local)];
  };
  for (int e = 0; e < mesh.ElementCount(); ++e)
    for (int f = 0; f < 4; ++f) {
      Face face{{}, e, f};
      for (std::size_t i = 0; i < 3; ++i)
        face.corners[i] = node(e, kTetFaces[static_cast<std::size_t>(f)][i]);
      std::ranges::sort(face.corners);
      faces.push_back(face);
    }
  std::ranges::stable_sort(faces, {}, &Face::corners);
  std::vector<int> nodes;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].corners == faces[i].corners) ++end;
    if (end == i + 1)
      for (std::size_t k = 0; k < (mesh.order == 2 ? 6u : 3u); ++k)
        nodes.push_back(
            node(faces[i].element, kTetFaces[static_cast<std::size_t>(faces[i].face)][k]));
    i = end;
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

ObstacleContact::ObstacleContact(const TetMesh& mesh, std::span<const std::uint8_t> fixed,
                                 std::span<const double> share) {
  for (const int node : SurfaceNodes(mesh)) {
    const auto i = static_cast<std::size_t>(node);
    if (i < fixed.size() && (fixed[i] & kHeld) == kHeld) continue;
    nodes_.push_back({.index = node,
                      .seen = mesh.rest_positions[i],
                      .share = i < share.size() ? share[i] : 1.0});
  }
}

void ObstacleContact::AcceptRestOverlap(const RigidObstacle& obstacle,
                                        const Rigid3& portal_from_body,
                                        std::span<const glm::dvec3> rest) noexcept {
  for (Node& node : nodes_) {
    glm::dvec3 normal(0, 0, 1);
    const double gap =
        obstacle.Gap(portal_from_body * rest[static_cast<std::size_t>(node.index)], normal);
    node.rest_gap = std::isfinite(gap) ? std::min(0.0, gap) : 0.0;
  }
  Forget();
}

void ObstacleContact::Forget() noexcept {
  for (Node& node : nodes_) node.clear = -1.0;
}

void ObstacleContact::Find(const RigidObstacle& obstacle, const Rigid3& portal_from_body,
                           std::span<const glm::dvec3> x, const ObstacleContactOptions& options,
                           std::vector<ContactPoint>& contacts) noexcept {
  const glm::dquat body_from_portal = glm::conjugate(portal_from_body.rotation);
  for (Node& node : nodes_) {
    const glm::dvec3& place = x[static_cast<std::size_t>(node.index)];
    const glm::dvec3 gone = place - node.seen;
    if (node.clear > 0.0 && glm::dot(gone, gone) < node.clear * node.clear) continue;
    glm::dvec3 normal(0, 0, 1);
    const double gap = obstacle.Gap(portal_from_body * place, normal) - node.rest_gap;
    if (!std::isfinite(gap)) continue;
    node.seen = place;
    node.clear = kTrusted * (gap - options.margin);
    if (gap >= options.margin) continue;
    ContactPoint contact;
    contact.count = 1;
    contact.node[0] = node.index;
    contact.weight[0] = 1.0;
    contact.normal = body_from_portal * normal;
    contact.foot = place - gap * contact.normal;
    contact.stiffness = options.stiffness * node.share;
    contact.friction = options.friction;
    contact.start = place;
    contacts.push_back(contact);
  }
}

}  // namespace arthro::simulation
