// Lens of the scope in the round window, in a form for shaders: the difference of its radii from
// the equisolid ones [method.md, Oblique view] of the same field of view. Radii are in units of the
// window radius, from the optical axis; q = sin(θ/2) / sin(fov/4) is the equisolid one and r that
// of the lens. The window is the circle of the lens; the axis may lie beside its centre.
//   q = r · inward(r²),  r = q · outward(q²)
#pragma once

#include <array>
#include <optional>

#include <glm/vec2.hpp>

#include "simulation/scene/lens.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::simulation {

struct WindowLens {
  static constexpr int kTerms = 10;
  glm::dvec2 axis{0.0};  // position of the axis in the window, right and up
  std::array<double, kTerms> inward{1.0}, outward{1.0};
  double end = 4.0;  // r² and q² above which the factors are constant
  friend bool operator==(const WindowLens&, const WindowLens&) = default;
};
inline bool IsEquisolid(const WindowLens& lens) { return lens == WindowLens(); }

// Returns the full angle of the window of the lens, rad: from its file, else to the rim of its
// circle, else to the corners of its picture.
double WindowFieldOfView(const Lens& lens);

// Fits the lens to a window of `field_of_view`, which is its circle where that is the lens' own
// field of view. Interpolates at Chebyshev nodes, with an error of at most kWindowLensError radii,
// 1/20 px in a picture of 1024 px. Throws Error(kBadData) for a lens that ends within the window,
// or whose distortion cannot be fitted to that error.
inline constexpr double kWindowLensError = 1e-4;
WindowLens FitWindowLens(const Lens& lens, double field_of_view);

// Optics of the scope of a scene. The field of view of a lens file has precedence over that of the
// scene, and `field_of_view` over both. Throws as FitWindowLens does, with the name of the file.
struct ScopeOptics {
  double field_of_view = 1.5707963267948966;  // full
  WindowLens lens;
  LensCamera camera = {};
};
ScopeOptics OpticsOf(const ScopeSpec& scope, const std::optional<Lens>& lens,
                     std::optional<double> field_of_view = std::nullopt);

// Returns the unit ray in the portal frame of a place in the window, right and up in units of its
// radius.
glm::dvec3 RayThrough(const ScopeOptics& optics, const ScopeView& view,
                      const glm::dvec2& place) noexcept;
// Returns the place in the window of a direction from the tip, the inverse of RayThrough; one
// outside the window is more than 1 from its centre.
glm::dvec2 PlaceOf(const ScopeOptics& optics, const ScopeView& view,
                   const glm::dvec3& direction) noexcept;

// Evaluates the even polynomial `factor` at a squared radius.
double LensFactor(const std::array<double, WindowLens::kTerms>& factor, double squared) noexcept;

}  // namespace arthro::simulation
