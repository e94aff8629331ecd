#include "authoring/phantom/shape/noise.h"

#include <algorithm>
#include <cmath>

namespace arthro::authoring {
namespace {

// Factors that turn a lattice point's coordinates into its random bits.
constexpr std::uint32_t kLatticeX = 0x85EBCA6Bu, kLatticeY = 0xC2B2AE35u, kLatticeZ = 0x27D4EB2Fu;
inline std::uint32_t Bits(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
  std::uint32_t h = x ^ (y + seed) ^ (z + seed * 0x9E3779B1u);
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

inline std::uint32_t Whole(double floored) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(floored));
}

// Quintic blend with zero first and second derivatives at 0 and 1 [Perlin 2002].
inline double Fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

// Directions spread evenly over the sphere along a spiral; each lattice point selects one.
constexpr std::uint32_t kDirections = 64;
struct Directions {
  glm::dvec3 of[kDirections];
  Directions() {
    for (std::uint32_t i = 0; i < kDirections; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kDirections, r = std::sqrt(1.0 - z * z);
      const double turn = 2.399963229728653 * i;  // the golden angle
      of[i] = {r * std::cos(turn), r * std::sin(turn), z};
    }
  }
};
const Directions kDirection;

inline double Slope(std::uint32_t bits, double x, double y, double z) {
  const glm::dvec3& g = kDirection.of[bits % kDirections];
  return g.x * x + g.y * y + g.z * z;
}

}  // namespace

double GradientNoise(const glm::dvec3& p, std::uint32_t seed) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const double x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const double u = Fade(x), v = Fade(y), w = Fade(z);
  const std::uint32_t x0 = Whole(fx) * kLatticeX, x1 = x0 + kLatticeX;
  const std::uint32_t y0 = Whole(fy) * kLatticeY, y1 = y0 + kLatticeY;
  const std::uint32_t z0 = Whole(fz) * kLatticeZ, z1 = z0 + kLatticeZ;
  const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, double dx, double dy,
                      double dz) { return Slope(Bits(i, j, k, seed), dx, dy, dz); };
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const double near = mix(mix(at(x0, y0, z0, x, y, z), at(x1, y0, z0, x - 1, y, z), u),
                          mix(at(x0, y1, z0, x, y - 1, z), at(x1, y1, z0, x - 1, y - 1, z), u), v);
  const double far =
      mix(mix(at(x0, y0, z1, x, y, z - 1), at(x1, y0, z1, x - 1, y, z - 1), u),
          mix(at(x0, y1, z1, x, y - 1, z - 1), at(x1, y1, z1, x - 1, y - 1, z - 1), u), v);
  return 1.25 * mix(near, far, w);
}

double FractalNoise(const glm::dvec3& p, int octaves, std::uint32_t seed) {
  double sum = 0.0, strength = 0.5;
  glm::dvec3 q = p;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += strength * GradientNoise(q, seed + static_cast<std::uint32_t>(octave) * 101u);
    // Rotation between octaves, so that their lattices never align.
    q = 2.03 * glm::dvec3(0.8 * q.x - 0.6 * q.z, 0.6 * q.x * 0.28 + 0.96 * q.y + 0.8 * q.z * 0.28,
                          0.6 * q.x + 0.8 * q.z);
    strength *= 0.5;
  }
  return sum;
}

double LobeNoise(const glm::dvec3& p, std::uint32_t seed) {
  // Soft maximum of bells, one per lattice cell: log Σ exp(-k d²) / k is -d² to the nearest point
  // with rounded creases. Lobes differ in size by `share`.
  constexpr double kSharpness = 7.0;
  // The bell reaches zero at 1.3 cells, inside the 27 cells searched.
  constexpr double kReach = 1.69;  // squared cells
  constexpr double kMostShare = 1.15, kMostReach = kReach * kMostShare * kMostShare;
  constexpr double kStep = 1.0 / 255.0;
  const glm::dvec3 base(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const glm::dvec3 offset = base - p;
  const std::uint32_t x0 = Whole(base.x) * kLatticeX, y0 = Whole(base.y) * kLatticeY,
                      z0 = Whole(base.z) * kLatticeZ;
  double sum = 0.0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint32_t h = Bits(x0 + static_cast<std::uint32_t>(dx) * kLatticeX,
                                     y0 + static_cast<std::uint32_t>(dy) * kLatticeY,
                                     z0 + static_cast<std::uint32_t>(dz) * kLatticeZ, seed);
        const double x = offset.x + dx + kStep * static_cast<double>(h & 255u),
                     y = offset.y + dy + kStep * static_cast<double>((h >> 8) & 255u),
                     z = offset.z + dz + kStep * static_cast<double>((h >> 16) & 255u);
        const double distance2 = x * x + y * y + z * z;
        if (distance2 >= kMostReach) continue;
        const double share = 0.85 + 0.3 * kStep * static_cast<double>(h >> 24);
        const double d2 = distance2 / (share * share);
        const double fade = 1.0 - d2 / kReach;
        if (fade <= 0.0) continue;
        sum += fade * fade * std::exp(-kSharpness * d2);
      }
  constexpr double kSpread = 1.8;  // brings creases near 0
  const double height = 1.0 + kSpread * std::log(sum + 1e-3) / kSharpness;
  // Rounded minimum away from all lobes.
  constexpr double kRounding = 0.06;  // squared height
  return std::min(0.5 * (height + std::sqrt(height * height + kRounding)), 1.0);
}

double SmoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace arthro::authoring
