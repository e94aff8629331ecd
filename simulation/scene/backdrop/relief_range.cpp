#include "simulation/scene/backdrop/relief_range.h"

#include <cmath>

#include "simulation/scene/projection.h"

namespace arthro {

double ReliefRange(const glm::dvec3& direction, const DepthMap& depth,
                   const Backdrop& backdrop) noexcept {
  if (depth.empty()) return backdrop.radius;
  const auto pixel = PixelFromDirection(backdrop.projection, direction);
  if (!pixel) return std::nan("");
  const double u = std::round(pixel->x), v = std::round(pixel->y);
  if (!(u >= 0 && v >= 0 && u < depth.width && v < depth.height)) return std::nan("");
  return backdrop.radius - static_cast<double>(depth.at(static_cast<int>(u), static_cast<int>(v)));
}

}  // namespace arthro
