// Razer Hydra: two hands with position and orientation in one report at 250 Hz [devices.md, Report
// layouts]. Layout of a hand: int16 position in mm at 0, 2, 4 of its part, int16 quaternion w, x,
// y, z over 32768 at 6 to 12, 7 bits of buttons at 14, int16 stick at 15 and 17, byte of the
// trigger at 19; the parts begin at 8 and 30. Frame of the base: m.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/device/codec/report_bytes.h"

namespace arthro::simulation {

struct HydraHand {
  glm::dvec3 position{0.0};
  glm::dquat orientation{1, 0, 0, 0};  // unit
  std::uint8_t buttons = 0;            // 7 bits
  glm::dvec2 stick{0.0};               // −1 to 1
  double trigger = 0;                  // 0 to 1
};

// Decodes a report. nullopt: a wrong length, or an invalid quaternion (its length differs from 1 by
// 0.1).
std::optional<std::array<HydraHand, 2>> ParseHydra(ReportBytes report) noexcept;

// Returns the feature report that makes the base send motion, or stop.
std::array<std::uint8_t, 91> HydraMotionReport(bool is_on) noexcept;

}  // namespace arthro::simulation
