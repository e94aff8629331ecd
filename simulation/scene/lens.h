// The lens of an arthroscope: where a ray falls in the raw picture, and back. Camera frame: +z
// along the optical axis, +x to the picture's right, +y down. θ is the angle between ray and axis,
// r the distance from (cx, cy) in px as they are along x: r² = (x - cx)² + (aspect (y - cy))².
//   equisolid       r = 2 f sin(θ/2)                              the paper's
//   kannala_brandt  r = f θ (1 + k0 θ² + k1 θ⁴ + k2 θ⁶ + k3 θ⁸)    [Kannala & Brandt 2006]
//   double_sphere   r = f sin θ / (α d + (1 - α)(ξ + cos θ)),       [Usenko et al. 2018]
//                   d² = sin²θ + (ξ + cos θ)², k0 = ξ in (-1, 1], k1 = α in [0, 1]
//   pinhole         r = f tan θ
// Files: lens_io.h [method.md, File formats].
#pragma once

#include <array>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/lens_camera.h"

namespace arthro {

enum class LensModel { kEquisolid, kKannalaBrandt, kDoubleSphere, kPinhole };

// The round window in the raw picture, px. The sensor may cut its top, bottom or sides off.
struct LensCircle {
  double cx = 0, cy = 0, r = 0;
  friend bool operator==(const LensCircle&, const LensCircle&) = default;
  template <class V>
  void Visit(V&& v) {
    constexpr Range kPixel{-1e5, 1e5};  // the centre may lie outside of the picture
    v("cx", cx, Required{kPixel}, "px", "Column of its centre.");
    v("cy", cy, Required{kPixel}, "px", "Row of its centre.");
    v("r", r, Required{Range{0, 1e5}}, "px", "Radius; 0: there is no round window.");
  }
};

struct Lens {
  LensModel model = LensModel::kEquisolid;
  int width = 0, height = 0;  // px; size of the raw pictures
  double focal_px = 0, cx = 0, cy = 0;
  double aspect = 1;          // a pixel's height over its width, as r is measured along x
  std::array<double, 4> k{};  // meaning by model
  double field_of_view = 0;   // full, rad: of the circle, or of the picture's diagonal
  LensCircle circle;          // r = 0: there is no round window
  double rms_px = 0;          // residual of the fit; 0 when it was not fitted
  LensCamera camera;
  friend bool operator==(const Lens&, const Lens&) = default;
};

// Nothing where the model has no pixel (behind the camera of a pinhole) or no ray (beyond the
// model). The ray need not be unit; the one returned is.
std::optional<glm::dvec2> PixelFromRay(const Lens& lens, const glm::dvec3& ray) noexcept;
std::optional<glm::dvec3> RayFromPixel(const Lens& lens, const glm::dvec2& pixel) noexcept;

// r of a ray at θ (rad), and θ of an r: the profile of the lens, without its centre.
std::optional<double> RadiusFromAngle(const Lens& lens, double theta) noexcept;
std::optional<double> AngleFromRadius(const Lens& lens, double radius) noexcept;

// dr/dθ at the axis, px/rad: the focal length of the pinhole that agrees with the lens there. It is
// focal_px for all models but the double sphere, whose f is (1 + ξ) times it.
double FocalAtAxis(const Lens& lens) noexcept;

// Full angle of what the picture holds, rad: to the rim of the circle, or without one to the
// picture's furthest corner. Nothing where the model ends before.
std::optional<double> FieldOfViewOf(const Lens& lens) noexcept;

}  // namespace arthro
