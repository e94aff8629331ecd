// Tissue material: hyperelastic laws with energy density Ψ(F), first Piola-Kirchhoff stress P =
// ∂Ψ/∂F, and optional fibres. Lamé μ = E/(2(1+ν)), λ = Eν/((1+ν)(1−2ν)), J = det F:
//   stable neo-Hookean (Smith, de Goes, Kim 2018, no log term):
//     Ψ = μ/2 (I₁−3) + (λ+μ)/2 (J−a)² + c, a = 1 + μ/(λ+μ), c chosen so that Ψ(I) = 0
//   corotated: Ψ = μ‖F−R‖² + λ/2 tr(RᵀF−I)²
//   fibres along the unit vector d at rest: + k/2 (|F d| − 1)²
// SI units: Pa, kg/m³.
#pragma once

#include "simulation/core/options.h"
#include "simulation/scene/elasticity.h"

namespace arthro::simulation {

enum class Law { kStableNeoHookean, kCorotated };
// kCircumferentialZ: unit tangent of circles about the mesh's z axis, at rest.
enum class FibreAxis { kNone, kCircumferentialZ };

struct Material {
  Law law = Law::kStableNeoHookean;
  double young_modulus = 5e5;
  double poisson_ratio = 0.45;
  double density = 1100.0;
  double fibre_stiffness = 0.0;
  FibreAxis fibre_axis = FibreAxis::kNone;
  bool fibres_bear_compression = true;  // false: tension only, C¹ at |F d| = 1
  template <class V>
  void Visit(V&& v) {
    v("model", law,
      Choices<Law>{
          {{Law::kStableNeoHookean, "stable_neo_hookean"}, {Law::kCorotated, "corotated"}}},
      "", "Law of the matrix between the fibres.");
    VisitElasticConstants(v, young_modulus, poisson_ratio, density, fibre_stiffness);
    v("fibre_axis", fibre_axis,
      Choices<FibreAxis>{
          {{FibreAxis::kNone, "none"}, {FibreAxis::kCircumferentialZ, "circumferential_z"}}},
      "", "Direction of the fibres at rest.");
    v("fibres_bear_compression", fibres_bear_compression, Any{}, "",
      "When off, fibres pull only when they are stretched.");
  }
};

struct Lame {
  double mu, lambda;  // Pa
};
inline Lame LameOf(const Material& m) {
  const double e = m.young_modulus, nu = m.poisson_ratio;
  return {e / (2.0 * (1.0 + nu)), e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))};
}

}  // namespace arthro::simulation
