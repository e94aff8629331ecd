// A random sequence of its own, SplitMix64 [Steele, Lea & Flood 2014]: short, and the same on every
// machine and standard library.
#pragma once

#include <cstdint>

namespace arthro {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::uint64_t Below(std::uint64_t count) { return Next() % count; }
  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(Next() >> 11) * 0x1.0p-53);
  }
  // `value` give or take a share of it, evenly spread: Near(10, 0.1) lies between 9 and 11.
  double Near(double value, double share) { return value * Uniform(1.0 - share, 1.0 + share); }

 private:
  std::uint64_t state_;
};

}  // namespace arthro
