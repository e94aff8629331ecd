#include "tests/support/view/slow_murk.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/vec3.hpp>

namespace arthro::test {
namespace {

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

}  // namespace

std::array<double, 3> SlowMurk(int seed, double time, const glm::dvec2& at) {
  const glm::dvec3 part(seed % 1009 * 13.0, seed / 1009 % 1009 * 29.0, 0), place(at, 0);
  const glm::dvec3 dew = 11.0 * (part + place) + glm::dvec3(0, 0, 90);
  return {Density(part + 2.6 * place + time * glm::dvec3(0.11, -0.04, 0.17)),
          Density(part + 5.2 * place + time * glm::dvec3(0.07, 0.05, 0.13) + glm::dvec3(0, 0, 40)),
          0.6 * Noise(dew) + 0.4 * Noise(2.7 * dew)};
}

}  // namespace arthro::test
