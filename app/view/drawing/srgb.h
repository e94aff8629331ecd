// Conversion between stored bytes (sRGB) and linear light, both 0 to 1; luma of a colour.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "app/view/shaders/constants.h"

namespace arthro::app {

inline double LinearFromSrgb(std::uint8_t byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

inline double SrgbFromLinear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// Returns the luma of linear light [ITU-R BT.709].
inline double Luma(const glm::dvec3& colour) {
  return glm::dot(colour, glm::dvec3(kLumaRed, kLumaGreen, kLumaBlue));
}

}  // namespace arthro::app
