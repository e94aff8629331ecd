#include "app/view/drawing/lens_shade.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace arthro::app {
namespace {

constexpr double kRodMargin = 1.3;     // times the radius
constexpr double kRodBeside = 0.3e-3;  // m

}  // namespace

bool MeetsRod(const glm::dvec3& ray, const LensRod& rod) noexcept {
  if (!(rod.radius > 0)) return false;
  // Closest points of the segment and the ray [Ericson 2005, 5.1.8].
  const glm::dvec3 along = rod.to - rod.from;
  const double b = glm::dot(ray, along), c = glm::dot(ray, rod.from), e = glm::dot(along, along),
               f = glm::dot(along, rod.from);
  const double across = e - b * b;
  double t = across > 1e-15 ? std::clamp((b * c - f) / across, 0.0, 1.0) : 0.0;
  const double s = std::max(c + t * b, 0.0);
  if (e > 0) t = std::clamp((s * b - f) / e, 0.0, 1.0);
  return glm::length(rod.from + t * along - s * ray) < kRodMargin * rod.radius + kRodBeside;
}

}  // namespace arthro::app
