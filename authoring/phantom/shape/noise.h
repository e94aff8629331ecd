// Seeded noise: the same seed and point give the same value on every thread. The caller scales the
// points; a feature is about one unit wide.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/random.h"

namespace arthro::authoring {

// Gradient noise, smooth to the second derivative, within about ±1 and zero on average.
double GradientNoise(const glm::dvec3& p, std::uint32_t seed);

// Octaves of gradient noise, each with half the size and half the amplitude of the one before;
// within about ±1.
double FractalNoise(const glm::dvec3& p, int octaves, std::uint32_t seed);

// Rounded lobes around scattered points, 0 in the creases to about 1 at the tops; creases are
// smooth.
double LobeNoise(const glm::dvec3& p, std::uint32_t seed);

// Returns 0 below `from`, 1 above `to`, a smooth value between; `from` may be the larger.
double SmoothStep(double from, double to, double x);

}  // namespace arthro::authoring
