// Numbers in HID reports: little-endian, two's complement, at a byte offset that the caller has
// checked to be there.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace arthro::simulation {

using ReportBytes = std::span<const std::uint8_t>;

constexpr std::uint16_t UnsignedAt(ReportBytes report, std::size_t at) noexcept {
  return static_cast<std::uint16_t>(report[at] | report[at + 1] << 8);
}
constexpr std::int16_t SignedAt(ReportBytes report, std::size_t at) noexcept {
  return std::bit_cast<std::int16_t>(UnsignedAt(report, at));
}
constexpr void PutSigned(std::span<std::uint8_t> report, std::size_t at,
                         std::int16_t value) noexcept {
  const auto bits = std::bit_cast<std::uint16_t>(value);
  report[at] = static_cast<std::uint8_t>(bits & 0xff);
  report[at + 1] = static_cast<std::uint8_t>(bits >> 8);
}

// Rounds to the nearest 16-bit number, NaN to 0. A cast of a larger number would change its sign,
// and so the direction of the force.
inline std::int16_t Saturated(double value) noexcept {
  if (std::isnan(value)) return 0;
  if (value >= 32767.0) return 32767;
  if (value <= -32767.0) return -32767;
  return static_cast<std::int16_t>(std::lround(value));
}

}  // namespace arthro::simulation
