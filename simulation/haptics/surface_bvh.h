// A triangle surface as something to bump into: a ball is swept along a segment and the first
// triangle it meets is found through a bounding-volume tree in flat arrays. Exact for faces, edges
// and corners, so a proxy that moves only by sweeps cannot tunnel. Triangles stop what comes from
// their outside (counter-clockwise) and let pass what leaves. Portal frame, m. Sweep is noexcept,
// allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro::simulation {

struct SweepHit {
  double fraction = 1;         // of the way, 0..1, where the ball touches
  glm::dvec3 normal{0, 0, 1};  // unit, from the surface to the ball's centre
  double gap = 0;              // m, negative where the ball was in the surface at the start
  int triangle = -1;           // of the tree; give it back as `first` next time
};

class SurfaceBvh {
 public:
  SurfaceBvh() = default;  // nothing to bump into
  // Triangles with no area are left out.
  SurfaceBvh(const SurfaceMesh& mesh, const Pose& portal_from_mesh);

  // Does a ball going from `from` to `to` meet the surface? `hit` is changed only for a meeting
  // earlier than hit.fraction. The triangle `first` is tried first: in lasting contact it ends the
  // search at once.
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
             SweepHit& hit) const noexcept;

  bool empty() const { return nodes_.empty(); }
  std::size_t triangle_count() const { return triangles_.size(); }

 private:
  struct Triangle {
    std::array<glm::dvec3, 3> corner;
    glm::dvec3 normal;
  };
  // Children of an inner node are node + 1 and `next`; a leaf has count > 0 triangles from `next`.
  struct Node {
    std::array<float, 3> low, high;  // rounded outwards
    std::int32_t next = 0, count = 0;
  };
  void Build(int first, int count);
  static bool SweepTriangle(const Triangle& triangle, const glm::dvec3& from,
                            const glm::dvec3& motion, double radius, SweepHit& hit) noexcept;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double triangle_size_ = 0;  // m, root of their mean area
};

}  // namespace arthro::simulation
