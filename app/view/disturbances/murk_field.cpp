#include "app/view/disturbances/murk_field.h"

#include <algorithm>
#include <cmath>

#include <glm/vec3.hpp>

namespace arthro::app {
namespace {

// 0 to 1.
float Lattice(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t h = x * 0x8da6b343u + y * 0xd8163841u + z * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * (1.0f / 16777215.0f);
}

// Value noise, 0 to 1, smooth in all three coordinates.
float Noise(const glm::vec3& p) {
  const glm::vec3 cell(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const glm::vec3 f = p - cell, u = f * f * (3.0f - 2.0f * f);
  const auto x = static_cast<std::uint32_t>(static_cast<std::int32_t>(cell.x)),
             y = static_cast<std::uint32_t>(static_cast<std::int32_t>(cell.y)),
             z = static_cast<std::uint32_t>(static_cast<std::int32_t>(cell.z));
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const auto plane = [&](std::uint32_t k) {
    return mix(mix(Lattice(x, y, k), Lattice(x + 1, y, k), u.x),
               mix(Lattice(x, y + 1, k), Lattice(x + 1, y + 1, k), u.x), u.y);
  };
  return mix(plane(z), plane(z + 1), u.z);
}

// Clouds with wisps: three octaves of noise at places displaced by noise, as fluid folds what it
// carries. Mean about 1/2.
float Density(const glm::vec3& p) {
  const glm::vec3 shifted = p + 1.7f * glm::vec3(Noise(p + glm::vec3(31, 7, 3)) - 0.5f,
                                                 Noise(p + glm::vec3(5, 47, 11)) - 0.5f, 0.0f);
  const float cloud = Noise(shifted), finer = Noise(2.1f * shifted + glm::vec3(17, 3, 23)),
              finest = Noise(4.3f * shifted + glm::vec3(2, 41, 7));
  const float sum = 0.55f * cloud + 0.29f * finer + 0.16f * finest;
  return std::clamp(0.5f + 1.7f * (sum - 0.5f), 0.0f, 1.0f);
}

std::uint8_t Byte(float share) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

}  // namespace

std::vector<std::uint8_t> MurkField(int seed, double time) {
  std::vector<std::uint8_t> texels;
  texels.reserve(std::size_t{4} * kMurkSize * kMurkSize);
  // Each seed has its own part of an endless noise; the fluid drifts and turns over slowly.
  const glm::vec3 part(static_cast<float>(seed % 1009) * 13.0f,
                       static_cast<float>((seed / 1009) % 1009) * 29.0f, 0.0f);
  const auto t = static_cast<float>(time);
  for (int j = 0; j < kMurkSize; ++j)
    for (int i = 0; i < kMurkSize; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) / kMurkSize,
                  y = (static_cast<float>(j) + 0.5f) / kMurkSize;
      const glm::vec3 place = part + glm::vec3(x, y, 0.0f);
      const glm::vec3 near =
          part + glm::vec3(2.6f * x + 0.11f * t, 2.6f * y - 0.04f * t, 0.17f * t);
      const glm::vec3 far =
          part + glm::vec3(5.2f * x + 0.07f * t, 5.2f * y + 0.05f * t, 40.0f + 0.13f * t);
      const glm::vec3 dew = 11.0f * place + glm::vec3(0, 0, 90.0f);
      texels.push_back(Byte(Density(near)));
      texels.push_back(Byte(Density(far)));
      texels.push_back(Byte(0.6f * Noise(dew) + 0.4f * Noise(2.7f * dew)));
      texels.push_back(255);
    }
  return texels;
}

}  // namespace arthro::app
