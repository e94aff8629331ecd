#include "simulation/scope/arthroscope.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace arthro::simulation {

ScopeView ViewFromPose(const RodPose& pose, double view_angle,
                       std::optional<double> head_roll) noexcept {
  const RodBasis basis = BasisOf(pose);
  const glm::dvec3 t = std::cos(pose.roll) * basis.north + std::sin(pose.roll) * basis.east;
  const double cos_a = std::cos(view_angle), sin_a = std::sin(view_angle);
  ScopeView view;
  view.tip = pose.depth * basis.axis;
  view.view = cos_a * basis.axis + sin_a * t;
  view.up = cos_a * t - sin_a * basis.axis;
  view.right = glm::cross(view.view, view.up);
  if (head_roll) {
    // Roll runs from north towards east, that is from up towards right.
    const double turn = *head_roll - pose.roll;
    const glm::dvec3 up = view.up, right = view.right;
    view.up = std::cos(turn) * up + std::sin(turn) * right;
    view.right = std::cos(turn) * right - std::sin(turn) * up;
  }
  return view;
}

double CentreAngle(double view_angle, double insertion_depth, double radius) noexcept {
  return view_angle -
         std::asin(std::clamp(insertion_depth / radius * std::sin(view_angle), -1.0, 1.0));
}

glm::dvec3 SphereHit(const glm::dvec3& origin, const glm::dvec3& direction,
                     double radius) noexcept {
  // Solves |o + s d|² = D² for the larger root; b² + c is kept at zero or above.
  const double b = glm::dot(origin, direction);
  const double c = radius * radius - glm::dot(origin, origin);
  return origin + direction * (std::sqrt(std::max(b * b + c, 0.0)) - b);
}

glm::dvec3 CentreDirection(const RodPose& pose, double view_angle, double radius) noexcept {
  const ScopeView view = ViewFromPose(pose, view_angle);
  return glm::normalize(SphereHit(view.tip, view.view, radius));
}

RoundWindow WindowOfSize(double field_of_view, int size) noexcept {
  return {field_of_view, glm::dvec2((size - 1) / 2.0), size / 2.0};
}

std::optional<glm::dvec3> RayFromPixel(const RoundWindow& window, const ScopeView& view,
                                       const glm::dvec2& pixel) noexcept {
  const glm::dvec2 offset = pixel - window.centre_px;
  const double r = glm::length(offset);
  if (!(r <= window.radius_px)) return std::nullopt;
  if (r == 0.0) return view.view;
  const double theta = 2.0 * std::asin(r / window.radius_px * std::sin(window.field_of_view / 4.0));
  const glm::dvec3 across = (offset.x * view.right - offset.y * view.up) / r;
  return std::cos(theta) * view.view + std::sin(theta) * across;
}

glm::dvec2 PixelFromRay(const RoundWindow& window, const ScopeView& view,
                        const glm::dvec3& direction) noexcept {
  const double x = glm::dot(direction, view.right), y = -glm::dot(direction, view.up);
  const double z = glm::dot(direction, view.view);
  const double across = std::hypot(x, y);
  if (across == 0.0 && z >= 0.0) return window.centre_px;
  const double theta = std::atan2(across, z);
  const double r = window.radius_px * std::sin(theta / 2.0) / std::sin(window.field_of_view / 4.0);
  // Straight behind, every side is equivalent.
  const glm::dvec2 side = across > 0.0 ? glm::dvec2(x, y) / across : glm::dvec2(1.0, 0.0);
  return window.centre_px + r * side;
}

}  // namespace arthro::simulation
