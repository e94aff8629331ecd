// Exact model of the oblique arthroscope over a backdrop sphere [method.md, Oblique view; paper,
// 3.3].
// Portal frame, m, rad.
//   t = cos γ·north + sin γ·east,  v = cos α·u + sin α·t,  up = cos α·t − sin α·u,  right = v × up
//   β(ρ) = α − asin((ρ/D)·sin α): angular distance of the view axis' hit from the rod's direction
#pragma once

#include <numbers>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {

// Position of the scope's lens, and unit axes of its view.
struct ScopeView {
  glm::dvec3 tip{0.0}, view{0, 0, 1}, up{0, -1, 0}, right{1, 0, 0};
};

// Computes the view. Head roll κ turns up and right about v by κ − γ; nullopt: the camera head
// turns with the scope.
ScopeView ViewFromPose(const RodPose& pose, double view_angle,
                       std::optional<double> head_roll = std::nullopt) noexcept;

// Returns β(ρ). Needs |ρ| ≤ D.
double CentreAngle(double view_angle, double insertion_depth, double radius) noexcept;

// Returns the point where a ray from inside leaves the sphere of `radius` about the portal. The
// origin may lie outside by rounding; further out, the point of the line nearest to the sphere is
// returned, so the result is always finite. `direction` is unit.
glm::dvec3 SphereHit(const glm::dvec3& origin, const glm::dvec3& direction, double radius) noexcept;

// Returns the direction from the portal to P′, the point of the sphere at the centre of the view.
glm::dvec3 CentreDirection(const RodPose& pose, double view_angle, double radius) noexcept;

// Round window without a lens file: equisolid, r = R sin(θ/2) / sin(fov/4), r in pixels from its
// centre. In a picture of size x size the window is centred at ((size−1)/2, (size−1)/2) with R =
// size/2.
struct RoundWindow {
  double field_of_view = std::numbers::pi / 2;  // full angle, rad
  glm::dvec2 centre_px{0.0};
  double radius_px = 1.0;
};
RoundWindow WindowOfSize(double field_of_view, int size) noexcept;

// Returns the unit ray of a pixel in the portal frame; nullopt outside the window.
std::optional<glm::dvec3> RayFromPixel(const RoundWindow& window, const ScopeView& view,
                                       const glm::dvec2& pixel) noexcept;

// Returns the pixel of a direction from the tip; a direction outside the window gives a pixel
// outside it.
glm::dvec2 PixelFromRay(const RoundWindow& window, const ScopeView& view,
                        const glm::dvec3& direction) noexcept;

}  // namespace arthro::simulation
