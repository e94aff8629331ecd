// Elastic constants of a tissue. The scene, tissue presets and cases of the solver share one list
// of them. SI.
#pragma once

#include <optional>
#include <string>

#include "simulation/core/options.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {

// Number: double, or std::optional<double> where a preset gives the value otherwise. Outside of
// these ranges the material laws cannot be evaluated (simulation/tissue/fem/material.h).
template <class V, class Number>
void VisitElasticConstants(V&& v, Number& young_modulus, Number& poisson_ratio, Number& density,
                           Number& fibre_stiffness) {
  v("young_modulus", young_modulus, Range{1.0, 1e12}, "Pa", "Stiffness at small strain.");
  v("poisson_ratio", poisson_ratio, Range{-0.9, 0.49999}, "",
    "How little the volume changes; 0.5 would be not at all.");
  v("density", density, Range{1e-3, 1e6}, "kg/m3", "Mass per volume.");
  v("fibre_stiffness", fibre_stiffness, Range{0.0, 1e12}, "Pa",
    "Stiffness of the fibres along fibre_axis; 0: no fibres.");
}

inline constexpr const char* kFibreAxes[] = {"none", "circumferential_z"};

// Values of a tissue that differ from those of its preset.
struct Elasticity {
  std::optional<double> young_modulus, poisson_ratio, density, fibre_stiffness;
  std::string fibre_axis;                 // one of kFibreAxes; empty: the preset's
  std::optional<double> layer_thickness;  // m
  friend bool operator==(const Elasticity&, const Elasticity&) = default;

  template <class V>
  void Visit(V&& v) {
    VisitElasticConstants(v, young_modulus, poisson_ratio, density, fibre_stiffness);
    v("fibre_axis", fibre_axis, Words{kFibreAxes}, "",
      "Direction of the fibres; circumferential_z: along circles about the mesh's own z axis.");
    v("layer_thickness", layer_thickness, kLength, "m",
      "Thickness of a thin layer on bone, which has no mesh.");
  }
};

}  // namespace arthro
