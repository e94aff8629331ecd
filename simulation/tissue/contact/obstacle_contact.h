// Contact of tissue with rigid obstacles: surface nodes near an obstacle are kept out of its local
// half space. A distant node is not tested again before it could have come near. Own frame, m, N.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/tissue/contact/contact_point.h"

namespace arthro::simulation {

// Rigid obstacle that supports tissue and cannot be entered: the backdrop's relief or a rigid
// model. Implemented by the owner of the depth field or mesh. Portal frame, m.
class RigidObstacle {
 public:
  virtual ~RigidObstacle() = default;
  // Returns the distance of x above the surface (negative inside), exact near it, and the unit
  // normal there.
  virtual double Gap(const glm::dvec3& x, glm::dvec3& normal) const noexcept = 0;
};

struct ObstacleContactOptions {
  double stiffness = 1000.0;  // N/m per node; several times the body's own, E times an edge length
  double friction = 0.03;
  double margin = 5e-4;  // m; nearer nodes are watched; limit of a node's motion per step
};

class ObstacleContact {
 public:
  // `fixed` has one byte per node, 7 for an immovable one (solver's FixedAxes), or is empty.
  // `share` is the remaining volume fraction at each node (FemModel::NodeShares), or empty for 1.
  // It scales the stiffness of each node, so that nodes of removed tissue rest on nothing.
  ObstacleContact(const TetMesh& mesh, std::span<const std::uint8_t> fixed,
                  std::span<const double> share = {});

  // Accepts overlaps at rest, since models are placed by hand: a node that lies below the obstacle
  // at rest is only pushed out of deeper positions. `rest` holds the mesh's rest positions.
  void AcceptRestOverlap(const RigidObstacle& obstacle, const Rigid3& portal_from_body,
                         std::span<const glm::dvec3> rest) noexcept;

  // Appends the contacts (owner −1) of the nodes at `x`. Allocates only if `contacts` must grow.
  void Find(const RigidObstacle& obstacle, const Rigid3& portal_from_body,
            std::span<const glm::dvec3> x, const ObstacleContactOptions& options,
            std::vector<ContactPoint>& contacts) noexcept;
  // Call after the obstacle, the body's pose or the margin has changed.
  void Forget() noexcept;

  int watched_nodes() const noexcept { return static_cast<int>(nodes_.size()); }

 private:
  struct Node {
    int index = 0;
    glm::dvec3 seen{0.0};  // position at the last test
    double clear = -1;     // distance that it may move without a test; negative: not tested yet
    double rest_gap = 0;   // m, 0 or below: gap at rest
    double share = 1;      // fraction of the stiffness
  };
  std::vector<Node> nodes_;
};

// Returns the nodes of faces that belong to one element only, rising.
std::vector<int> SurfaceNodes(const TetMesh& mesh);

}  // namespace arthro::simulation
