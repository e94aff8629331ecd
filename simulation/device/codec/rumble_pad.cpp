#include "simulation/device/codec/rumble_pad.h"

#include <algorithm>
#include <cmath>
#include <zlib.h>

namespace arthro::simulation {
namespace {

constexpr std::uint8_t kBluetoothSeed = 0xa2;  // header byte in the checksum, absent over USB

std::uint8_t Byte(double amplitude) noexcept {
  if (!(amplitude > 0)) return 0;  // also for NaN
  return static_cast<std::uint8_t>(std::lround(255.0 * std::min(amplitude, 1.0)));
}

// Layout of one kind of report of a pad: constant `head` bytes, then zeros except for the two
// motors, the weak one first.
template <std::size_t kSize, std::size_t kHead>
std::array<std::uint8_t, kSize> Report(const std::array<std::uint8_t, kHead>& head,
                                       std::size_t motors, const Rumble& rumble) noexcept {
  std::array<std::uint8_t, kSize> report{};
  std::copy(head.begin(), head.end(), report.begin());
  report[motors] = Byte(rumble.weak);
  report[motors + 1] = Byte(rumble.strong);
  return report;
}

template <std::size_t kSize>
std::array<std::uint8_t, kSize> Closed(std::array<std::uint8_t, kSize> report) noexcept {
  uLong sum = crc32(0, &kBluetoothSeed, 1);
  sum = crc32(sum, report.data(), kSize - 4);
  for (std::size_t i = 0; i < 4; ++i)
    report[kSize - 4 + i] = static_cast<std::uint8_t>(sum >> (8 * i) & 0xff);
  return report;
}

// Flags after the report number: the outputs to change.
constexpr std::uint8_t kSenseMotors = 0x03;  // both motors
constexpr std::uint8_t kShockMotors = 0x01;  // neither light nor flash
constexpr std::uint8_t kShockHid = 0xc0;     // HID, with checksum
constexpr std::uint8_t kSenseHid = 0x02;

// Decodes three bytes: square, cross, circle, triangle above four bits of the direction pad; L1 to
// R3; PS and the touchpad.
std::uint32_t ButtonsAt(ReportBytes report, std::size_t at) noexcept {
  const std::uint32_t face = report[at] >> 4;
  const std::uint32_t square = face & 1, others = face >> 1;  // cross, circle, triangle
  return (others & 3) | square << 2 | (others >> 2) << 3 |
         static_cast<std::uint32_t>(report[at + 1]) << 4 | (report[at + 2] & 3u) << 12;
}

constexpr std::size_t kUsbReport = 64, kShortReport = 10, kLongReport = 78;
constexpr std::size_t kShortButtons = 5;  // also their place in the USB report of a DualShock 4

}  // namespace

std::array<std::uint8_t, 48> DualSenseUsb(const Rumble& rumble) noexcept {
  return Report<48>(std::array<std::uint8_t, 2>{0x02, kSenseMotors}, 3, rumble);
}

std::array<std::uint8_t, 78> DualSenseBluetooth(const Rumble& rumble) noexcept {
  return Closed(Report<78>(std::array<std::uint8_t, 3>{0x31, kSenseHid, kSenseMotors}, 4, rumble));
}

std::array<std::uint8_t, 32> DualShock4Usb(const Rumble& rumble) noexcept {
  return Report<32>(std::array<std::uint8_t, 2>{0x05, kShockMotors}, 4, rumble);
}

std::array<std::uint8_t, 78> DualShock4Bluetooth(const Rumble& rumble) noexcept {
  return Closed(
      Report<78>(std::array<std::uint8_t, 4>{0x11, kShockHid, 0x00, kShockMotors}, 6, rumble));
}

std::optional<std::uint32_t> ParseDualSense(ReportBytes report) noexcept {
  if (report.size() == kUsbReport && report[0] == 0x01) return ButtonsAt(report, 8);
  if (report.size() == kLongReport && report[0] == 0x31) return ButtonsAt(report, 9);
  if (report.size() == kShortReport && report[0] == 0x01) return ButtonsAt(report, kShortButtons);
  return std::nullopt;
}

std::optional<std::uint32_t> ParseDualShock4(ReportBytes report) noexcept {
  const bool is_short = report.size() == kUsbReport || report.size() == kShortReport;
  if (is_short && report[0] == 0x01) return ButtonsAt(report, kShortButtons);
  if (report.size() == kLongReport && report[0] == 0x11) return ButtonsAt(report, 7);
  return std::nullopt;
}

}  // namespace arthro::simulation
