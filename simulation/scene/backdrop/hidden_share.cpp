#include "simulation/scene/backdrop/hidden_share.h"

#include <glm/geometric.hpp>

#include "simulation/scene/backdrop/relief_range.h"

namespace arthro {

double HiddenShare(const SurfaceMesh& surface, const Pose& portal_from_surface,
                   const DepthMap& depth, const Backdrop& backdrop) {
  if (surface.vertices.empty()) return 0;
  std::size_t hidden = 0;
  for (const glm::dvec3& vertex : surface.vertices) {
    const glm::dvec3 x = portal_from_surface * vertex;
    const double range = glm::length(x);
    // False for NaN.
    if (range > 0 && range > ReliefRange(x / range, depth, backdrop)) ++hidden;
  }
  return static_cast<double>(hidden) / static_cast<double>(surface.vertices.size());
}

}  // namespace arthro
