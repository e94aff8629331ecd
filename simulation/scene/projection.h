// Pixel of the panorama for a direction seen from the scope portal [method.md, Projection].
// Picture, force and authoring use this one model. Directions are in the portal frame (+z into the
// joint, +x right, +y down) and need not be unit; pixels have their origin at the centre of the
// top-left pixel, x right, y down.
//   gnomonic         u = c_x + f x/z,  v = c_y + f y/z            (what a homography mosaic is)
//   equirectangular  u = c_x + k λ,    v = c_y - k φ,  degrees;   λ = atan2(x, z),  φ = -asin(y)
// The direction (x, y, z) of these formulas is the one in the portal frame, turned back about +z by
// `roll`: a picture whose top is not up in the joint is turned, and its pixels stay as they are.
#pragma once

#include <numbers>
#include <optional>

#include <glm/mat2x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/options.h"

namespace arthro {

enum class ProjectionType { kGnomonic, kEquirectangular };

struct Projection {
  ProjectionType type = ProjectionType::kGnomonic;
  glm::dvec2 centre_px{0.0};
  double focal_px = 1000.0;  // gnomonic
  double px_per_deg = 10.0;  // equirectangular
  double roll = 0.0;         // rad, clockwise as seen from the portal
  friend bool operator==(const Projection&, const Projection&) = default;

  template <class V>
  void Visit(V&& v) {
    constexpr Range kPixel{-1e6, 1e6};  // the centre may lie far outside of the picture
    v("type", type,
      Required{Choices<ProjectionType>{{{ProjectionType::kGnomonic, "gnomonic"},
                                        {ProjectionType::kEquirectangular, "equirectangular"}}}},
      "", "How directions map to pixels.");
    v("centre_px", centre_px, Required{kPixel}, "px", "Pixel straight ahead of the portal.");
    v("focal_px", focal_px,
      OnlyIf{type == ProjectionType::kGnomonic, Required{Range{0, 1e6, true}}}, "px",
      "Focal length.");
    v("px_per_deg", px_per_deg,
      OnlyIf{type == ProjectionType::kEquirectangular, Required{Range{0, 1e5, true}}}, "px/deg",
      "Pixels per degree of longitude and latitude.");
    v("roll", roll, LeftOutAt{0.0, Range{-std::numbers::pi, std::numbers::pi}}, "rad",
      "Turn of the picture about the direction straight ahead, clockwise as seen from the portal.");
  }
};

// Nothing where the projection has no pixel: at a right angle to a gnomonic picture's axis and
// beyond, or no direction at all.
std::optional<glm::dvec2> PixelFromDirection(const Projection& projection,
                                             const glm::dvec3& direction) noexcept;

// Unit direction.
glm::dvec3 DirectionFromPixel(const Projection& projection, const glm::dvec2& pixel) noexcept;

// Rows: gradient of u and of v with respect to the direction, px per unit of direction;
// PixelFromDirection must have a value there. Infinite at the poles of an equirectangular picture
// is avoided by a floor of 1e-9 on the distance from the axis.
glm::dmat2x3 PixelGradients(const Projection& projection, const glm::dvec3& direction) noexcept;

// Length of the longer of both gradients in the unit direction of a pixel, in closed form: px per
// unit of direction.
double LongerPixelGradient(const Projection& projection, const glm::dvec2& pixel) noexcept;

}  // namespace arthro
