#include "simulation/device/live/device_survey.h"

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/simulation/device/live/arm_bench.h"

namespace arthro::simulation {
namespace {

const std::string kSurveyed = "/dev/fake0";

using test::FakeUsb;

TEST(DeviceSurvey, ListsDevicesWithTheirObstacles) {
  test::TempFolder folder;
  FakeUsb usb;
  const auto bus = MachineHidBus();
  EXPECT_TRUE(SurveyDevices(*bus, "", folder.path()).devices.empty());
  usb.Plug(test::WoodenArm(L"A", kSurveyed));
  usb.Plug({0x256f, 0xc635, 1, 8, 0, false, L"7", L"", "/dev/fake1"});
  usb.Plug({0x256f, 0xc635, 1, 8, 0, false, L"8", L"", "/dev/fake2"});
  usb.Plug({0x046d, 0xc077, 1, 2, 0, false, L"", L"a mouse", "/dev/fake3"});
  usb.RefuseToOpen("/dev/fake2", true);
  const DeviceLock lock(folder.path(), "space_mouse-7");
  const DeviceSurvey survey = SurveyDevices(*bus, "", folder.path());
  EXPECT_EQ(survey.nodes, 4);
  ASSERT_EQ(survey.devices.size(), 3u);
  EXPECT_FALSE(survey.devices[0].can_be_used);
  EXPECT_NE(survey.devices[0].sentence.find("name its model"), std::string::npos);
  EXPECT_FALSE(survey.devices[1].can_be_used);
  EXPECT_EQ(survey.devices[1].sentence,
            "process " + std::to_string(getpid()) + " uses it; close that program");
  EXPECT_FALSE(survey.devices[2].can_be_used);
  EXPECT_EQ(survey.devices[2].caps.input, HandInput::kRate);
  const DeviceSurvey named = SurveyDevices(*bus, "polhem_v1", folder.path());
  EXPECT_TRUE(named.devices[0].can_be_used);
  EXPECT_TRUE(HasForce(named.devices[0].caps));
  EXPECT_TRUE(usb.Written(kSurveyed).empty()) << "nobody was spoken to";
  EXPECT_EQ(usb.opened(kSurveyed), 0);
  EXPECT_EQ(usb.misuses(), 0);
}

TEST(DeviceTrial, AnAnsweringArmPassesWithoutForce) {
  test::TempFolder folder;
  FakeUsb usb;
  test::Board board(usb, kSurveyed);
  usb.Plug(test::WoodenArm(L"A", kSurveyed));
  LiveOptions options;
  options.lock_folder = folder.path();
  const auto bus = MachineHidBus();
  const DeviceTrial trial =
      TryDevice(*bus, {DeviceFamily::kWoodenHaptics, "A", "polhem_v1"}, 0.3, options);
  // The rate depends on the machine; this checks only that the count agrees with it.
  EXPECT_GT(trial.taken, 10);
  EXPECT_NEAR(trial.rate, static_cast<double>(trial.taken) / trial.seconds, 1e-9);
  EXPECT_EQ(trial.rejected, 0);
  EXPECT_EQ(trial.has_passed, trial.rate >= 800 && trial.full_rings == 0) << trial.sentence;
  for (const auto& report : usb.Written(kSurveyed)) EXPECT_EQ(report, test::Bytes(15));
}

TEST(DeviceTrial, InvalidReportsFailIt) {
  test::TempFolder folder;
  FakeUsb usb;
  usb.OnWrite(kSurveyed, [&](const test::Bytes&) { usb.Send(kSurveyed, test::Bytes(13)); });
  usb.Plug(test::WoodenArm(L"A", kSurveyed));
  LiveOptions options;
  options.lock_folder = folder.path();
  const auto bus = MachineHidBus();
  const DeviceTrial trial =
      TryDevice(*bus, {DeviceFamily::kWoodenHaptics, "A", "polhem_v1"}, 0.2, options);
  EXPECT_FALSE(trial.has_passed);
  EXPECT_GT(trial.rejected, 0);
  EXPECT_NE(trial.sentence.find("could not be understood"), std::string::npos) << trial.sentence;
}

}  // namespace
}  // namespace arthro::simulation
