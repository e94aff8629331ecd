// Contact with a triangle surface: sweeps a ball along a segment and finds the first triangle that
// it meets, by a bounding-volume hierarchy in flat arrays. Exact for faces, edges and corners, so a
// proxy that moves only by sweeps cannot tunnel. Triangles stop motion from their outside
// (counter-clockwise) and let motion from the inside pass. Portal frame, m. Sweep is noexcept,
// allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/core/geometry/triangle.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::simulation {

struct SweepHit {
  double fraction = 1;         // share of the way at contact, 0..1
  glm::dvec3 normal{0, 0, 1};  // unit, from the surface to the centre of the ball
  double gap = 0;              // m, negative where the ball started inside the surface
  int triangle = -1;           // index in the hierarchy; pass it as `first` next time
};

// Sweeps a ball onto one triangle of unit normal `normal`: the step that all surfaces of triangles
// share. Returns true and changes `hit`, except for hit.triangle, only for an earlier contact.
bool SweepTriangle(const TriangleCorners& corner, const glm::dvec3& normal, const glm::dvec3& from,
                   const glm::dvec3& motion, double radius, SweepHit& hit) noexcept;

class SurfaceBvh {
 public:
  SurfaceBvh() = default;  // no surface
  // Omits triangles without area.
  SurfaceBvh(const SurfaceMesh& mesh, const Pose& portal_from_mesh);

  // Sweeps a ball from `from` to `to`. Returns true and changes `hit` only for a contact earlier
  // than hit.fraction. The triangle `first` is tried first, which ends the search at once in
  // lasting contact.
  bool Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
             SweepHit& hit) const noexcept;

  bool empty() const { return nodes_.empty(); }
  std::size_t triangle_count() const { return triangles_.size(); }

 private:
  struct Triangle {
    TriangleCorners corner;
    glm::dvec3 normal;
  };
  // Children of an inner node are node + 1 and `next`; a leaf has count > 0 triangles, beginning at
  // `next`.
  struct Node {
    std::array<float, 3> low, high;  // rounded outwards
    std::int32_t next = 0, count = 0;
  };
  void Build(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double triangle_size_ = 0;  // m, square root of the mean area
};

}  // namespace arthro::simulation
