// The oblique arthroscope over a backdrop sphere, exactly [method.md, Oblique view; paper, 3.3].
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

// Where the scope's lens is and looks; unit axes.
struct ScopeView {
  glm::dvec3 tip{0.0}, view{0, 0, 1}, up{0, -1, 0}, right{1, 0, 0};
};

// Head roll κ turns up and right about v by κ − γ; without one the camera head turns with the
// scope.
ScopeView ViewFromPose(const RodPose& pose, double view_angle,
                       std::optional<double> head_roll = std::nullopt) noexcept;

// β(ρ). Needs |ρ| ≤ D.
double CentreAngle(double view_angle, double insertion_depth, double radius) noexcept;

// The point where a ray from inside leaves the sphere of `radius` about the portal. The origin may
// lie up to rounding outside; further out, the nearest point of the line to the sphere is taken, so
// the result is always finite. `direction` is unit.
glm::dvec3 SphereHit(const glm::dvec3& origin, const glm::dvec3& direction, double radius) noexcept;

// Direction from the portal of P′, the point of the sphere at the centre of the view.
glm::dvec3 CentreDirection(const RodPose& pose, double view_angle, double radius) noexcept;

// The round window with no lens file: equisolid, r = R sin(θ/2) / sin(fov/4), r in pixels from its
// centre. A picture of size x size has its window centred at ((size−1)/2, (size−1)/2) with R =
// size/2.
struct RoundWindow {
  double field_of_view = std::numbers::pi / 2;  // full
  glm::dvec2 centre_px{0.0};
  double radius_px = 1.0;
};
RoundWindow WindowOfSize(double field_of_view, int size) noexcept;

// Unit ray in the portal frame of a pixel of the window; nothing outside the window.
std::optional<glm::dvec3> RayFromPixel(const RoundWindow& window, const ScopeView& view,
                                       const glm::dvec2& pixel) noexcept;

// Pixel of a direction seen from the tip; a direction outside the window lands outside it.
glm::dvec2 PixelFromRay(const RoundWindow& window, const ScopeView& view,
                        const glm::dvec3& direction) noexcept;

}  // namespace arthro::simulation
