// Tissue against what it rests on: nodes of the body's surface that come near a rigid obstacle are
// held out of the half space that the obstacle is there. Nodes far off are not looked at again
// before they could have come near. Own frame, m, N.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/core/frames.h"
#include "simulation/scene/tet_mesh.h"
#include "simulation/tissue/contact/contact_point.h"
#include "simulation/tissue/contact/rigid_obstacle.h"

namespace arthro::simulation {

struct ObstacleContactOptions {
  double stiffness = 1000.0;  // N/m a node; some times the body's own, E times a cell's edge
  double friction = 0.03;
  double margin = 5e-4;  // m, nearer than this a node is watched; what it may move in a step
};

class ObstacleContact {
 public:
  // `fixed`: a byte a node, 7 for one that cannot move (solver's FixedAxes); or empty. `share`:
  // what is left of the tissue about a node (FemModel::NodeShares), or empty: all of it. A node is
  // held out by that part of the stiffness: what stands for nothing but cut away tissue rests on
  // nothing.
  ObstacleContact(const TetMesh& mesh, std::span<const std::uint8_t> fixed,
                  std::span<const double> share = {});

  // A node that lies below the obstacle when nothing is deformed rests there, since models are laid
  // by hand: from now on only what it goes deeper counts. `rest`: the mesh's rest positions.
  void LayAtRest(const RigidObstacle& obstacle, const Rigid3& portal_from_body,
                 std::span<const glm::dvec3> rest) noexcept;

  // Appends the contacts (owner −1) of the nodes at `x`. Allocates only where `contacts` must grow.
  void Find(const RigidObstacle& obstacle, const Rigid3& portal_from_body,
            std::span<const glm::dvec3> x, const ObstacleContactOptions& options,
            std::vector<ContactPoint>& contacts) noexcept;
  // After the obstacle, the body's pose or the margin changed.
  void Forget() noexcept;

  int watched_nodes() const noexcept { return static_cast<int>(nodes_.size()); }

 private:
  struct Node {
    int index = 0;
    glm::dvec3 seen{0.0};  // where it was when it was last looked at
    double clear = -1;     // how far it may go from there unseen; negative: not seen yet
    double rest_gap = 0;   // m, 0 or below: where it lay before
    double share = 1;      // of the stiffness
  };
  std::vector<Node> nodes_;
};

// Nodes of faces that only one element has, rising.
std::vector<int> SurfaceNodes(const TetMesh& mesh);

}  // namespace arthro::simulation
