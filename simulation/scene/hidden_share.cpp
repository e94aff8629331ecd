#include "simulation/scene/hidden_share.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/scene/projection.h"

namespace arthro {

double ReliefTowards(const glm::dvec3& direction, const DepthMap& depth, const Backdrop& backdrop) {
  if (depth.empty()) return 0;
  const auto pixel = PixelFromDirection(backdrop.projection, direction);
  if (!pixel) return std::nan("");
  const double u = std::round(pixel->x), v = std::round(pixel->y);
  if (!(u >= 0 && v >= 0 && u < depth.width && v < depth.height)) return std::nan("");
  return depth.at(static_cast<int>(u), static_cast<int>(v));
}

double HiddenShare(const SurfaceMesh& surface, const Pose& portal_from_surface,
                   const DepthMap& depth, const Backdrop& backdrop) {
  if (surface.vertices.empty()) return 0;
  std::size_t hidden = 0;
  for (const glm::dvec3& vertex : surface.vertices) {
    const glm::dvec3 x = portal_from_surface * vertex;
    const double range = glm::length(x);
    // False for NaN.
    if (range > 0 && range > backdrop.radius - ReliefTowards(x / range, depth, backdrop)) ++hidden;
  }
  return static_cast<double>(hidden) / static_cast<double>(surface.vertices.size());
}

}  // namespace arthro
