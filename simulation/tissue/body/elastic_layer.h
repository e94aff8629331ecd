// Cartilage that is not cut, without a mesh: an elastic layer of even thickness, bonded to rigid
// bone, pressed by something small and smooth without friction. A wide press feels a Winkler
// foundation of the aggregate modulus over the thickness; a small one feels a half space (Hertz);
// between them, and near ν = 0.5, both are wrong by factors, and the contact problem of the bonded
// layer [Lebedev & Ufliand 1958; Hayes et al. 1972; Jaffar 1989] is solved once, when the layer is
// made. Pressing then reads a curve: noexcept, no allocation. What a ball is more curved than the
// paraboloid of that theory is put right by the ratio of the two on a half space [Sneddon 1965].
// Linear theory: beside quadratic elements with the stable neo-Hookean law it is within 5 % up to a
// depth of a tenth of the thickness and within 10 % up to a fifth; `is_deep` says when a mesh
// should take over. m, N, Pa.
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
  static constexpr double kDeepShare = 0.3;      // of the thickness
  static constexpr double kDeepBallShare = 0.8;  // of a ball's radius: its sides begin to touch

  // Of the material only E and ν count: law and fibres differ at strains that this is not for.
  // Throws Error(kBadArgument) for a thickness, modulus or Poisson's ratio that is not one.
  ElasticLayer(const Material& material, double thickness);

  double thickness() const noexcept { return thickness_; }
  // Pa/m: pressure over depth where the contact is much wider than the layer is thick.
  double foundation() const noexcept { return foundation_; }

  // A ball of this radius whose lowest point is `depth` under the surface at rest. Depths ≤ 0,
  // radii ≤ 0 and values that are not finite: no force.
  LayerTouch PressBall(double radius, double depth) const noexcept;
  // The flat end of a round rod of this radius, square on the surface.
  LayerTouch PressFlat(double radius, double depth) const noexcept;
  // A long round rod that lies on it: force and stiffness a metre of it (N/m, N/m²), contact_radius
  // half the width. Plane strain; of its cross-section the curvature counts, the rest of the
  // circle does not.
  LayerTouch PressLine(double radius, double depth) const noexcept;
  // The other way round: how deep it is when it is pushed with `force`. PressX(depth).force is
  // `force` to 1e-9 of it.
  double BallDepth(double radius, double force) const noexcept;
  double FlatDepth(double radius, double force) const noexcept;

 private:
  // Contact radii over thickness from 0.01 to 10, evenly in the logarithm. Smaller is a half space
  // to 1 %, larger goes on as a power.
  static constexpr std::size_t kSamples = 28;
  using Curve = std::array<double, kSamples>;

  double thickness_ = 0, foundation_ = 0;
  double flat_unit_ =
      0;  // N/m: force over depth of a flat end as large as the layer is thick, κ = 1
  Curve log_radius_{};                               // ln(a/h)
  Curve log_kappa_{}, kappa_slope_{};                // over log_radius_
  Curve log_depth_{}, log_force_{}, force_slope_{};  // ball: ln(δ R/h²), ln(F R/(flat_unit h²))
  Curve radius_slope_{};                             // of log_radius_ over log_depth_
  double line_unit_ = 0;                             // Pa: πμ/(1 − ν)
  // Line: half the width is exp(log_radius_) h; ln(δ R/h²), ln(F' R/(line_unit h²)).
  Curve log_line_depth_{}, log_line_force_{}, line_force_slope_{}, line_radius_slope_{};
};

}  // namespace arthro::simulation
