// Profiles r(θ) that a fit can try, with their derivatives. Parameters: f (px), then the model's
// own; simulation/scene/lens.h lists the profiles that a lens file can hold. Equidistant is
// Kannala-Brandt with all k = 0. Stereographic, r = 2 f tan(θ/2), is the double sphere with ξ = 0,
// α = 1/2.
#pragma once

#include <array>
#include <span>

#include "simulation/scene/lens.h"

namespace arthro::authoring {

enum class FitModel {
  kEquisolid,
  kEquidistant,
  kDoubleSphere,
  kKannalaBrandt,
  kStereographic,
  kPinhole
};

inline constexpr int kMostOwnParameters = 4;

// "equisolid", "equidistant", …
const char* ToString(FitModel model);

int OwnParametersOf(FitModel model);  // parameters besides f

struct RadialValue {
  double r = 0, by_theta = 0, by_focal = 0;
  std::array<double, kMostOwnParameters> by_own{};
};

// Returns false when the model has no value at θ.
bool EvaluateRadius(FitModel model, double focal, std::span<const double> own, double theta,
                    RadialValue& value);

// Initial values of a fit: own parameters that make the model nearly equisolid. `focal` goes in as
// the focal length of an equisolid lens and comes out as the model's f.
std::array<double, kMostOwnParameters> StartOf(FitModel model, double& focal);

// Writes model, focal_px and k of a lens file.
void StoreModel(FitModel model, double focal, std::span<const double> own, Lens& lens);

}  // namespace arthro::authoring
