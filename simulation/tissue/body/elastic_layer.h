// Uncut cartilage without a mesh: an elastic layer of constant thickness, bonded to rigid bone,
// pressed without friction by a small smooth body.
//
// A wide contact feels a Winkler foundation: aggregate modulus over thickness. A small one feels a
// half space (Hertz). Between these limits, and near ν = 0.5, both are wrong by large factors. The
// contact problem of the bonded layer [Lebedev & Ufliand 1958; Hayes et al. 1972; Jaffar 1989] is
// therefore solved once, when the layer is made. Pressing then evaluates a curve: noexcept, no
// allocation. The theory assumes a paraboloid; the ratio of ball to paraboloid on a half space
// [Sneddon 1965] corrects for a ball.
//
// Linear theory: compared with quadratic elements and the stable neo-Hookean law the error is
// within 5 % up to a depth of a tenth of the thickness and within 10 % up to a fifth. `is_deep`
// tells when a mesh should take over. m, N, Pa.
#pragma once

#include <array>
#include <cstddef>

#include "simulation/tissue/fem/material.h"

namespace arthro::simulation {

struct LayerTouch {
  double force = 0;           // N, on the tool, along the layer's normal
  double stiffness = 0;       // N/m, d force / d depth
  double contact_radius = 0;  // m
  bool is_deep = false;       // too deep for this theory: use a mesh
};

class ElasticLayer {
 public:
  static constexpr double kDeepShare = 0.3;      // fraction of the thickness
  static constexpr double kDeepBallShare = 0.8;  // over a ball's radius: its sides begin to touch

  // Uses only E and ν of the material; law and fibres matter at larger strains only. Throws
  // Error(kBadArgument) for an invalid thickness, modulus or Poisson's ratio.
  ElasticLayer(const Material& material, double thickness);

  double thickness() const noexcept { return thickness_; }
  // Pa/m: pressure over depth for a contact much wider than the thickness.
  double foundation() const noexcept { return foundation_; }

  // Presses a ball of this radius to `depth` below the surface at rest. Returns no force for a
  // depth or radius ≤ 0 or a value that is not finite.
  LayerTouch PressBall(double radius, double depth) const noexcept;
  // Presses the flat end of a round rod of this radius, perpendicular to the surface.
  LayerTouch PressFlat(double radius, double depth) const noexcept;
  // Presses a long round rod that lies on the surface: force and stiffness per metre (N/m, N/m²),
  // contact_radius half the width. Plane strain; the cross-section is approximated by its
  // curvature.
  LayerTouch PressLine(double radius, double depth) const noexcept;
  // Inverse functions: return the depth for a force. PressX(depth).force equals `force` to 1e-9.
  double BallDepth(double radius, double force) const noexcept;
  double FlatDepth(double radius, double force) const noexcept;

 private:
  // Contact radii over thickness from 0.01 to 10, evenly in the logarithm. Smaller values are a
  // half space to 1 %; larger ones continue as a power.
  static constexpr std::size_t kSamples = 28;
  using Curve = std::array<double, kSamples>;

  double thickness_ = 0, foundation_ = 0;
  double flat_unit_ =
      0;  // N/m: force per depth of a flat end of radius equal to the thickness, κ = 1
  Curve log_radius_{};                               // ln(a/h)
  Curve log_kappa_{}, kappa_slope_{};                // over log_radius_
  Curve log_depth_{}, log_force_{}, force_slope_{};  // ball: ln(δ R/h²), ln(F R/(flat_unit h²))
  Curve radius_slope_{};                             // d log_radius_ / d log_depth_
  double line_unit_ = 0;                             // Pa: πμ/(1 − ν)
  // Line: half the width is exp(log_radius_) h; ln(δ R/h²), ln(F' R/(line_unit h²)).
  Curve log_line_depth_{}, log_line_force_{}, line_force_slope_{}, line_radius_slope_{};
};

}  // namespace arthro::simulation
