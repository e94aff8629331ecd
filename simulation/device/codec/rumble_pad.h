// What makes a DualSense or a DualShock 4 rumble [notes on haptics, 1.1]: amplitude 0 to 1 of the
// strong (left) and the weak (right) motor, as USB or Bluetooth output reports, the latter closed
// by a CRC-32 that begins with the byte A2.
#pragma once

#include <array>
#include <cstdint>

namespace arthro::simulation {

struct Rumble {
  double strong = 0, weak = 0;
};

std::array<std::uint8_t, 48> DualSenseUsb(const Rumble& rumble) noexcept;
std::array<std::uint8_t, 78> DualSenseBluetooth(const Rumble& rumble) noexcept;
std::array<std::uint8_t, 32> DualShock4Usb(const Rumble& rumble) noexcept;
std::array<std::uint8_t, 78> DualShock4Bluetooth(const Rumble& rumble) noexcept;

}  // namespace arthro::simulation
