// The scope's own lens in the round window, as a shader can take it: how its radii differ from the
// equisolid ones [method.md, Oblique view] of the same field of view. Radii are in those of the
// window; q = sin(θ/2) / sin(fov/4) is the equisolid one, r the lens', both from the optical axis,
// and the window is the lens' own circle, about whose centre the axis may lie aside.
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
  glm::dvec2 axis{0.0};  // where the axis stands in the window, right and up
  std::array<double, kTerms> inward{1.0}, outward{1.0};
  double end = 4.0;  // r² and q² beyond which the factors stay as they are
  friend bool operator==(const WindowLens&, const WindowLens&) = default;
};
inline bool IsEquisolid(const WindowLens& lens) { return lens == WindowLens(); }

// Full angle of the lens' window, rad: what its file says, else to the rim of its circle, else of
// its picture's corners.
double WindowFieldOfView(const Lens& lens);

// The window is as wide as `field_of_view`; where that is the lens' own it is its circle.
// Polynomials through Chebyshev's points, off by at most kWindowLensError radii: a twentieth of a
// pixel of 1024. Throws Error(kBadData) for a lens that ends within the window, or bends too much
// for that.
inline constexpr double kWindowLensError = 1e-4;
WindowLens FitWindowLens(const Lens& lens, double field_of_view);

// What the scope of a scene looks through. A lens file's own field of view counts before the
// scene's, and one that is asked for before both. Throws as FitWindowLens, naming the file.
struct ScopeOptics {
  double field_of_view = 1.5707963267948966;  // full
  WindowLens lens;
};
ScopeOptics OpticsOf(const ScopeSpec& scope, const std::optional<Lens>& lens,
                     std::optional<double> field_of_view = std::nullopt);

// Unit ray in the portal frame of a place in the window, right and up in its radii.
glm::dvec3 RayThrough(const ScopeOptics& optics, const ScopeView& view,
                      const glm::dvec2& place) noexcept;

// Even polynomial `factor` of a squared radius.
double LensFactor(const std::array<double, WindowLens::kTerms>& factor, double squared) noexcept;

}  // namespace arthro::simulation
