// Surface of a tissue before any cut. The skin of the remaining tissue comes from a grid, which
// makes thin edges lumpy. Away from cuts it is projected back onto this surface and relaxed along
// it, so that vertices are evenly spaced. m, the surface's own frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/contact/box_tree.h"
#include "simulation/tissue/contact/closest_points.h"

namespace arthro::simulation {

class UncutSurface {
 public:
  explicit UncutSurface(const SurfaceMesh& surface);

  // Returns the nearest point within the reach, or x itself if there is none.
  glm::dvec3 Nearest(const glm::dvec3& x, double reach) const noexcept;

 private:
  std::vector<TriangleCorners> triangles_;
  BoxTree tree_;
};

// Projects the vertices of a field's skin that lie well away from cuts onto the surface. Smooths
// the others by less than half a spacing. Moves flagged vertices only (empty: all).
void ProjectOnto(const UncutSurface& uncut, const SolidField& field,
                 std::span<const std::uint8_t> is_new, SurfaceMesh& skin);

}  // namespace arthro::simulation
