#include "simulation/device/codec/rumble_pad.h"

#include <cmath>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TEST(RumblePad, UsbReportsDriveBothMotors) {
  const auto sense = DualSenseUsb({1.0, 0.5});
  EXPECT_EQ(sense[0], 0x02);
  EXPECT_EQ(sense[1] & 3, 3);
  EXPECT_EQ(sense[3], 128) << "right, weak";
  EXPECT_EQ(sense[4], 255) << "left, strong";
  const auto shock = DualShock4Usb({0.25, 1.0});
  EXPECT_EQ(shock[0], 0x05);
  EXPECT_EQ(shock[1] & 1, 1);
  EXPECT_EQ(shock[4], 255);
  EXPECT_EQ(shock[5], 64);
}

TEST(RumblePad, ClampsTheAmplitudeToAByte) {
  for (const double none : {0.0, -3.0, std::nan("")}) EXPECT_EQ(DualSenseUsb({none, none})[4], 0);
  EXPECT_EQ(DualSenseUsb({1e300, 0})[4], 255);
}

// Reference checksum over a seed byte and the report, by bitwise division.
template <std::size_t kSize>
std::uint32_t SlowSum(const std::array<std::uint8_t, kSize>& report) {
  std::uint32_t sum = 0xffffffff;
  const auto add = [&](std::uint8_t byte) {
    sum ^= byte;
    for (int i = 0; i < 8; ++i) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0u);
  };
  add(0xa2);
  for (std::size_t i = 0; i + 4 < kSize; ++i) add(report[i]);
  return ~sum;
}
template <std::size_t kSize>
std::uint32_t Written(const std::array<std::uint8_t, kSize>& report) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum |= static_cast<std::uint32_t>(report[kSize - 4 + i]) << (8 * i);
  return sum;
}

TEST(RumblePad, BluetoothReportsCloseWithTheirChecksum) {
  const auto sense = DualSenseBluetooth({1.0, 0.5});
  const auto shock = DualShock4Bluetooth({1.0, 0.5});
  EXPECT_EQ(sense[0], 0x31);
  EXPECT_EQ(shock[0], 0x11);
  EXPECT_EQ((std::array{sense[1], sense[2], sense[3], sense[4], sense[5]}),
            (std::array<std::uint8_t, 5>{2, 3, 0, 128, 255}));
  EXPECT_EQ((std::array{shock[1], shock[2], shock[3], shock[6], shock[7]}),
            (std::array<std::uint8_t, 5>{0xc0, 0, 1, 128, 255}));
  EXPECT_EQ(Written(sense), SlowSum(sense));
  EXPECT_EQ(Written(shock), SlowSum(shock));
}

}  // namespace
}  // namespace arthro::simulation
