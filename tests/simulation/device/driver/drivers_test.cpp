#include "simulation/device/driver/drivers.h"

#include <vector>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes BytesOf(const OutputReport& report) { return {report.span().begin(), report.span().end()}; }

std::unique_ptr<DeviceDriver> Make(DeviceFamily family, bool is_bluetooth = false) {
  KnownDevice device;
  device.family = family;
  device.node.is_bluetooth = is_bluetooth;
  std::string refusal;
  return MakeDriver(device, "polhem_v1", refusal);
}

TEST(SpaceMouseDriver, ReadsPushTurnAndButtonsOfBothLayouts) {
  const auto driver = Make(DeviceFamily::kSpaceMouse);
  EXPECT_EQ(driver->caps().input, HandInput::kRate);
  EXPECT_EQ(driver->Take(Bytes{1, 0x5e, 1, 0xa2, 0xfe, 0xaf, 0}), ReportNews::kTaken);
  EXPECT_EQ(driver->Take(Bytes{2, 0, 0, 0x5e, 1, 0, 0}), ReportNews::kTaken);
  EXPECT_EQ(driver->Take(Bytes{3, 2, 0}), ReportNews::kTaken);
  HandReading hand = driver->Hand(0);
  EXPECT_EQ(hand.push, glm::dvec3(1, -1, 0.5));
  EXPECT_EQ(hand.turn, glm::dvec3(0, 1, 0));
  EXPECT_EQ(hand.sample.buttons, 2u);
  EXPECT_EQ(driver->Take(Bytes{1, 0, 0, 0, 0, 0, 0, 0x5e, 1, 0, 0, 0, 0}), ReportNews::kTaken);
  hand = driver->Hand(0);
  EXPECT_EQ(hand.push, glm::dvec3(0.0));
  EXPECT_EQ(hand.turn, glm::dvec3(1, 0, 0));
  EXPECT_EQ(driver->Take(Bytes{0x17, 50, 0}), ReportNews::kIgnored);
  EXPECT_EQ(driver->Take(Bytes{1, 0, 0}), ReportNews::kRejected);
  EXPECT_EQ(driver->ForceReport({1, 0, 0}, {}).size, 0u);
  driver->Forget();
  EXPECT_EQ(driver->Hand(0).turn, glm::dvec3(0.0)) << "plugged in again it stands still";
}

TEST(HydraDriver, ReadsTwoHandsFromOneReport) {
  const auto driver = Make(DeviceFamily::kHydra);
  ASSERT_EQ(driver->hands(), 2);
  Bytes report(52);
  const auto put = [&](std::size_t at, int value) {
    PutSigned(report, at, static_cast<std::int16_t>(value));
  };
  put(8, 100), put(10, -200), put(12, 300), put(14, 32767);
  report[22] = 0x81;  // the top bit is no button
  report[27] = 255;
  put(30, -1), put(32, -2), put(34, -3), put(38, -32768);
  ASSERT_EQ(driver->Take(report), ReportNews::kTaken);
  EXPECT_EQ(driver->Hand(0).sample.hip_in_device, glm::dvec3(0.1, -0.2, 0.3));
  EXPECT_EQ(driver->Hand(0).sample.buttons, 0x81u) << "the first, and the trigger as the eighth";
  EXPECT_EQ(driver->Hand(1).sample.hip_in_device, glm::dvec3(-0.001, -0.002, -0.003));
  EXPECT_EQ(driver->Hand(1).sample.handle_in_device, glm::dquat(0, -1, 0, 0));
  EXPECT_EQ(driver->Hand(1).sample.buttons, 0u);
}

TEST(HydraDriver, EncodesStartAndStop) {
  const auto driver = Make(DeviceFamily::kHydra);
  const Bytes start = BytesOf(driver->StartFeature()), stop = BytesOf(driver->StopFeature());
  ASSERT_EQ(start.size(), 91u);
  Bytes golden(91);
  golden[6] = 1, golden[8] = 4, golden[9] = 3, golden[89] = 6;
  EXPECT_EQ(start, golden);
  golden[9] = 0, golden[89] = 5;
  EXPECT_EQ(stop, golden);
}

TEST(PadDriver, AmplitudeIsTheForceInAnyDirection) {
  const auto dual_sense = Make(DeviceFamily::kDualSense);
  EXPECT_EQ(dual_sense->caps().feedback, Feedback::kRumble);
  EXPECT_FALSE(HasHand(dual_sense->caps()));
  EXPECT_FALSE(HasForce(dual_sense->caps()));
  for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}) {
    const Bytes half = BytesOf(dual_sense->ForceReport(1.65 * way, {}));
    ASSERT_EQ(half.size(), 48u);
    EXPECT_EQ(half[3], 128);
    EXPECT_EQ(half[4], 128);
    EXPECT_EQ(BytesOf(dual_sense->ForceReport(1e6 * way, {}))[4], 255);
  }
  EXPECT_EQ(BytesOf(dual_sense->ForceReport(glm::dvec3(std::nan("")), {}))[4], 0);
  EXPECT_EQ(Make(DeviceFamily::kDualShock4)->ForceReport({}, {}).size, 32u);
  EXPECT_EQ(Make(DeviceFamily::kDualSense, true)->ForceReport({}, {}).size, 78u);
  EXPECT_EQ(Make(DeviceFamily::kDualShock4, true)->ForceReport({}, {}).bytes[0], 0x11);
}

TEST(PadDriver, ButtonsHaveTheSameOrderOnBothPadsAndLinks) {
  // Number of the report, its length and the offset of its buttons.
  const auto check = [](DeviceFamily family, std::uint8_t id, std::size_t size, std::size_t at) {
    const auto driver = Make(family);
    Bytes report(size);
    report[0] = id;
    const std::vector<std::pair<std::array<std::uint8_t, 3>, std::uint32_t>> buttons{
        {{0x08, 0, 0}, 0},          {{0x28, 0, 0}, 1 << 0},     {{0x48, 0, 0}, 1 << 1},
        {{0x18, 0, 0}, 1 << 2},     {{0x88, 0, 0}, 1 << 3},     {{0x08, 0x01, 0}, 1 << 4},
        {{0x08, 0x80, 0}, 1 << 11}, {{0x08, 0, 0x01}, 1 << 12}, {{0x08, 0, 0x02}, 1 << 13},
        {{0x08, 0, 0xfc}, 0}};
    for (const auto& [bytes, bits] : buttons) {
      std::copy(bytes.begin(), bytes.end(), report.begin() + static_cast<std::ptrdiff_t>(at));
      ASSERT_EQ(driver->Take(report), ReportNews::kTaken);
      EXPECT_EQ(driver->Hand(0).sample.buttons, bits) << ToString(family) << " " << int{id};
      EXPECT_FALSE(driver->Hand(0).sample.valid) << "it knows of no hand";
    }
    report[0] = 0x55;
    EXPECT_EQ(driver->Take(report), ReportNews::kRejected);
  };
  check(DeviceFamily::kDualSense, 0x01, 64, 8);
  check(DeviceFamily::kDualSense, 0x31, 78, 9);
  check(DeviceFamily::kDualSense, 0x01, 10, 5);
  check(DeviceFamily::kDualShock4, 0x01, 64, 5);
  check(DeviceFamily::kDualShock4, 0x11, 78, 7);
}

}  // namespace
}  // namespace arthro::simulation
