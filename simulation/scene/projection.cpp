#include "simulation/scene/projection.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"

namespace arthro {

namespace {

// A turn about +z.
glm::dvec3 Rolled(const glm::dvec3& d, double roll) noexcept {
  if (roll == 0.0) return d;
  const double c = std::cos(roll), s = std::sin(roll);
  return {c * d.x - s * d.y, s * d.x + c * d.y, d.z};
}

}  // namespace

std::optional<glm::dvec2> PixelFromDirection(const Projection& projection,
                                             const glm::dvec3& direction) noexcept {
  const glm::dvec3 d = Rolled(direction, -projection.roll);
  if (projection.type == ProjectionType::kGnomonic) {
    // At a right angle, where cos 90° is 6e-17 in doubles, there is no pixel either.
    if (!(d.z > 1e-9 * (std::abs(d.x) + std::abs(d.y)))) return std::nullopt;
    return projection.centre_px + projection.focal_px * glm::dvec2(d.x, d.y) / d.z;
  }
  const double length = glm::length(d);
  if (!(length > 0.0)) return std::nullopt;
  const double longitude = std::atan2(d.x, d.z);
  const double latitude = -std::asin(std::clamp(d.y / length, -1.0, 1.0));
  return projection.centre_px + projection.px_per_deg * glm::dvec2(DegreesFromRadians(longitude),
                                                                   -DegreesFromRadians(latitude));
}

glm::dvec3 DirectionFromPixel(const Projection& projection, const glm::dvec2& pixel) noexcept {
  const glm::dvec2 offset = pixel - projection.centre_px;
  if (projection.type == ProjectionType::kGnomonic)
    return Rolled(glm::normalize(glm::dvec3(offset / projection.focal_px, 1.0)), projection.roll);
  const double longitude = RadiansFromDegrees(offset.x / projection.px_per_deg);
  const double latitude = RadiansFromDegrees(-offset.y / projection.px_per_deg);
  return Rolled({std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                 std::cos(latitude) * std::cos(longitude)},
                projection.roll);
}

glm::dmat2x3 PixelGradients(const Projection& projection, const glm::dvec3& direction) noexcept {
  const glm::dvec3 d = Rolled(direction, -projection.roll);
  const auto in_portal = [&](const glm::dvec3& of_u, const glm::dvec3& of_v) {
    return glm::dmat2x3(Rolled(of_u, projection.roll), Rolled(of_v, projection.roll));
  };
  if (projection.type == ProjectionType::kGnomonic) {
    const double f_z = projection.focal_px / d.z;
    return in_portal({f_z, 0.0, -f_z * d.x / d.z}, {0.0, f_z, -f_z * d.y / d.z});
  }
  // dλ = (z dx - x dz) / (x² + z²);  d(asin(y/r)) = (dy - y (d·dr)/r²) / sqrt(x² + z²)
  const double k = DegreesFromRadians(projection.px_per_deg);
  const double axis2 = std::max(d.x * d.x + d.z * d.z, 1e-18);
  const double r2 = axis2 + d.y * d.y;
  const double axis = std::sqrt(axis2);
  return in_portal(k / axis2 * glm::dvec3(d.z, 0.0, -d.x),
                   k / axis * (glm::dvec3(0.0, 1.0, 0.0) - d.y / r2 * d));
}

double LongerPixelGradient(const Projection& projection, const glm::dvec2& pixel) noexcept {
  const glm::dvec2 offset = pixel - projection.centre_px;
  if (projection.type == ProjectionType::kGnomonic) {
    // 1/d.z² = 1 + (x/z)² + (y/z)²
    const glm::dvec2 slope = offset / projection.focal_px, squares = slope * slope;
    return projection.focal_px *
           std::sqrt((1.0 + squares.x + squares.y) * (1.0 + std::max(squares.x, squares.y)));
  }
  // Longitude; the gradient of the latitude has the length k everywhere.
  const double latitude = RadiansFromDegrees(offset.y / projection.px_per_deg);
  return DegreesFromRadians(projection.px_per_deg) / std::max(std::abs(std::cos(latitude)), 1e-9);
}

}  // namespace arthro
