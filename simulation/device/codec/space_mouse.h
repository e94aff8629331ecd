// Codec of the SpaceMouse family: six axes of push and turn, and buttons [devices.md, Report
// layouts].
// Reports begin with their ID: 1 = int16 x, y, z, or on newer ones all six; 2 = int16 rx, ry, rz; 3
// = bits of buttons; others (battery) are ignored. Axes range to ±350 counts; layouts are
// distinguished by length, never by product.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "simulation/device/codec/report_bytes.h"

namespace arthro::simulation {

// Newest value of each axis; −1 to 1.
struct SpaceMouse {
  glm::dvec3 push{0.0}, turn{0.0};
  std::uint32_t buttons = 0;
};

enum class SpaceMouseNews { kRejected, kIgnored, kTaken };
// Takes a report. Rejects an unknown ID or a wrong length, and then leaves `mouse` unchanged.
SpaceMouseNews TakeReport(ReportBytes report, SpaceMouse& mouse) noexcept;

std::array<std::uint8_t, 2> SpaceMouseLight(bool is_on) noexcept;

}  // namespace arthro::simulation
