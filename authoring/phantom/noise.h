// Small seeded noise: the same seed and point give the same value on every thread. Points are in
// whatever unit the caller scales by; a feature is about one unit wide.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace arthro::authoring {

// A random sequence of its own (SplitMix64): short, portable, and the same on every standard
// library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t Next();
  double Uniform(double low, double high);
  // `value` give or take a share of it, evenly spread: Near(10, 0.1) lies between 9 and 11.
  double Near(double value, double share) { return value * Uniform(1.0 - share, 1.0 + share); }

 private:
  std::uint64_t state_;
};

// Gradient noise, smooth to the second derivative, within about ±1 and zero on average.
double GradientNoise(const glm::dvec3& p, std::uint32_t seed);

// Octaves of gradient noise, each twice as fine and half as strong; within about ±1.
double FractalNoise(const glm::dvec3& p, int octaves, std::uint32_t seed);

// Rounded lobes around scattered points, 0 in the creases to about 1 at the tops; creases are
// smooth.
double LobeNoise(const glm::dvec3& p, std::uint32_t seed);

// 0 below `from`, 1 above `to`, smooth between; `from` may be the larger.
double SmoothStep(double from, double to, double x);

}  // namespace arthro::authoring
