// The surface of a tissue before anything was taken of it. The skin of what is left comes from a
// grid, which makes thin edges lumpy; where no cut came near it is laid back onto this and relaxed
// along it, so that vertices are spread evenly. m, the surface's own frame.
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

  // The nearest place within the reach; else x itself.
  glm::dvec3 Nearest(const glm::dvec3& x, double reach) const noexcept;

 private:
  std::vector<TriangleCorners> triangles_;
  BoxTree tree_;
};

// Lays the vertices of a field's skin onto it that lie well away from what was cut, and evens out
// the others by less than half a spacing; of both only the ones that are flagged (empty: all).
void LayOnto(const UncutSurface& uncut, const SolidField& field,
             std::span<const std::uint8_t> is_new, SurfaceMesh& skin);

}  // namespace arthro::simulation
