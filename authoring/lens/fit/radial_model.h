// The profiles r(θ) that a fit can try, with their derivatives. Parameters: f (px), then the
// model's own; see simulation/scene/lens.h for those that a lens file can hold. Equidistant is
// Kannala-Brandt with all k = 0; stereographic, r = 2 f tan(θ/2), is the double sphere with
// ξ = 0, α = 1/2.
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
const char* WordOf(FitModel model);

int OwnParametersOf(FitModel model);  // beside f

struct RadialValue {
  double r = 0, by_theta = 0, by_focal = 0;
  std::array<double, kMostOwnParameters> by_own{};
};

// False where the model has no value at θ.
bool EvaluateRadius(FitModel model, double focal, std::span<const double> own, double theta,
                    RadialValue& value);

// The start of a fit: own parameters that make the model nearly equisolid, and the f that goes with
// an equisolid lens of focal length `focal`.
std::array<double, kMostOwnParameters> StartOf(FitModel model, double& focal);

// Model, focal_px and k of a lens file.
void StoreModel(FitModel model, double focal, std::span<const double> own, Lens& lens);

}  // namespace arthro::authoring
