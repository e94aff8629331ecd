// Light that a wet surface mirrors towards the lens, by the filling of the joint. At normal
// incidence it is F0 = ((n1 - n2) / (n1 + n2))^2 [Fresnel; Born & Wolf 1999, 1.5.2]. The refractive
// index of soft tissue is 1.35 to 1.41 [Bolin et al. 1989, doi:10.1364/AO.28.002297; Jacques 2013,
// doi:10.1088/0031-9155/58/11/R37].
#pragma once

#include "simulation/scene/scene.h"

namespace arthro {

inline constexpr double kTissueIndex = 1.38;
inline constexpr double kSalineIndex = 1.334;
inline constexpr double kGasIndex = 1.0;

// Returns F0 between two refractive indices.
constexpr double NormalReflectance(double n1, double n2) {
  const double root = (n1 - n2) / (n1 + n2);
  return root * root;
}

// Returns the mirrored light of tissue in a medium, as a share of that in gas: 1 or about 1/90.
constexpr double MirroredShare(Medium medium) {
  const double gas = NormalReflectance(kTissueIndex, kGasIndex);
  return medium == Medium::kGas ? 1.0 : NormalReflectance(kTissueIndex, kSalineIndex) / gas;
}

}  // namespace arthro
