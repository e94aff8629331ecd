// Constants that the shaders and C++ share; constants.inc says what they are, with units.
#pragma once

namespace arthro::app {

#define CONSTANT(name, value) inline constexpr double name = value;
#define COUNT(name, value) inline constexpr int name = value;
#include "app/view/shaders/constants.inc"
#undef CONSTANT
#undef COUNT

static_assert(kLampRadiusSquared == kLampRadius * kLampRadius);

// Returns the distance from the lens, m, of a stored depth (distance.glsl).
inline constexpr double DistanceFromStored(double depth) {
  return kNearest / (1.0 - depth * (kFarthest - kNearest) / kFarthest);
}

}  // namespace arthro::app
