#include "app/view/disturbances/murk_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace arthro::app {
namespace {

// The same field without shortcuts: each place from the eight corners of its cell, in double
// precision.
double Corner(double x, double y, double z) {
  const auto of = [](double v) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(v)); };
  std::uint32_t h = of(x) * 0x8da6b343u + of(y) * 0xd8163841u + of(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return ((h ^ (h >> 15)) >> 8) / 16777215.0;
}

double Noise(const glm::dvec3& p) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    glm::dvec3 at;
    for (int c = 0; c < 3; ++c) {
      const double f = p[c] - std::floor(p[c]), u = f * f * (3 - 2 * f);
      const int side = (corner >> c) & 1;
      at[c] = std::floor(p[c]) + side;
      weight *= side == 1 ? u : 1 - u;
    }
    sum += weight * Corner(at.x, at.y, at.z);
  }
  return sum;
}

double Density(const glm::dvec3& p) {
  const glm::dvec3 shifted = p + 1.7 * glm::dvec3(Noise(p + glm::dvec3(31, 7, 3)) - 0.5,
                                                  Noise(p + glm::dvec3(5, 47, 11)) - 0.5, 0);
  const double sum = 0.55 * Noise(shifted) + 0.29 * Noise(2.1 * shifted + glm::dvec3(17, 3, 23)) +
                     0.16 * Noise(4.3 * shifted + glm::dvec3(2, 41, 7));
  return std::clamp(0.5 + 1.7 * (sum - 0.5), 0.0, 1.0);
}

// Largest difference of a byte of the field.
double WorstOf(int seed, double t) {
  const std::vector<std::uint8_t> field = MurkField(seed, t);
  const glm::dvec3 part(seed % 1009 * 13.0, seed / 1009 % 1009 * 29.0, 0);
  double worst = 0;
  for (int j = 0; j < kMurkSize; ++j)
    for (int i = 0; i < kMurkSize; ++i) {
      const glm::dvec3 at((i + 0.5) / kMurkSize, (j + 0.5) / kMurkSize, 0);
      const glm::dvec3 dew = 11.0 * (part + at) + glm::dvec3(0, 0, 90);
      const double wanted[] = {
          Density(part + 2.6 * at + t * glm::dvec3(0.11, -0.04, 0.17)),
          Density(part + 5.2 * at + t * glm::dvec3(0.07, 0.05, 0.13) + glm::dvec3(0, 0, 40)),
          0.6 * Noise(dew) + 0.4 * Noise(2.7 * dew), 1};
      const std::uint8_t* texel = &field[static_cast<std::size_t>(4 * (j * kMurkSize + i))];
      for (int c = 0; c < 4; ++c) worst = std::max(worst, std::abs(texel[c] - 255 * wanted[c]));
    }
  return worst;
}

TEST(MurkField, IsTheNoiseOfItsPlaceWithinALevel) {
  for (const int seed : {0, 3})
    for (const double time : {0.0, 12.3, -77.7}) EXPECT_LT(WorstOf(seed, time), 1.0);
}

// Far out in the noise, single precision rounds a place by up to 0.03 cells of the finest drops,
// which are 0.4 of the dew and rise by at most 1.5 per cell: 5 levels.
TEST(MurkField, OfALargeSeedAndALateTimeIsTheSameWithinItsRounding) {
  for (const int seed : {1008, 2147483647})
    for (const double time : {0.0, 86400.0, -86400.0}) {
      const double worst = WorstOf(seed, time);
      std::printf("seed %d, %.0f s: at most %.1f levels from double precision\n", seed, time,
                  worst);
      EXPECT_LT(worst, 6.0);
    }
}

}  // namespace
}  // namespace arthro::app
