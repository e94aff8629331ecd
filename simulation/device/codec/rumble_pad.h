// Reports that make a DualSense or a DualShock 4 rumble [devices.md, Report layouts]: amplitude 0
// to 1 of the strong (left) and the weak (right) motor, as USB or Bluetooth output reports, the
// latter closed by a CRC-32 that begins with the byte A2. Buttons come in the report numbered 01
// over USB and, shorter, over Bluetooth until a longer one is requested; 31 and 11 are the long
// ones of Bluetooth [layouts as in the kernel's hid-playstation].
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "simulation/device/codec/report_bytes.h"

namespace arthro::simulation {

struct Rumble {
  double strong = 0, weak = 0;
};

std::array<std::uint8_t, 48> DualSenseUsb(const Rumble& rumble) noexcept;
std::array<std::uint8_t, 78> DualSenseBluetooth(const Rumble& rumble) noexcept;
std::array<std::uint8_t, 32> DualShock4Usb(const Rumble& rumble) noexcept;
std::array<std::uint8_t, 78> DualShock4Bluetooth(const Rumble& rumble) noexcept;

// Decodes buttons as bits from 0 on: cross, circle, square, triangle, L1, R1, L2, R2, create or
// share, options, L3, R3, PS, touchpad. nullopt: a report without buttons.
inline constexpr int kPadButtons = 14;
std::optional<std::uint32_t> ParseDualSense(ReportBytes report) noexcept;
std::optional<std::uint32_t> ParseDualShock4(ReportBytes report) noexcept;

}  // namespace arthro::simulation
