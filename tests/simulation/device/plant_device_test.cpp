#include "simulation/device/plant_device.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;

// Ticks with a constant force and returns the last sample.
DeviceSample Hold(Device& device, double& now, int ticks, const glm::dvec3& force, bool is_held) {
  DeviceSample sample;
  for (int i = 0; i < ticks; ++i, now += kTick) {
    sample = device.Read(now);
    device.HoldDeadMan(is_held);
    device.Command(force);
  }
  return sample;
}

TEST(PlantDevice, PushesOnlyWhenArmed) {
  PlantDevice device({}, kHand, glm::dvec3(0.0));
  double now = 0;
  EXPECT_FALSE(Hold(device, now, 2, {1, 0, 0}, false).valid) << "still being opened";
  EXPECT_EQ(Hold(device, now, 200, {1, 0, 0}, false).hip_in_device, glm::dvec3(0.0));
  EXPECT_EQ(device.state(), DeviceState::kReady);
  const DeviceSample pushed = Hold(device, now, 500, {1, 0, 0}, true);
  EXPECT_EQ(device.state(), DeviceState::kArmed);
  // At rest the spring of the hand, 300 N/m, holds 1 N less at most 0.26 N of friction.
  EXPECT_NEAR(pushed.hip_in_device.x, 1.0 / 300, 0.26 / 300);
  Hold(device, now, 1, {1, 0, 0}, false);
  EXPECT_EQ(device.force(), glm::dvec3(0.0)) << "let go";
}

TEST(PlantDevice, SilenceStopsTheForceAfter5MillisecondsAndIsALossAfter20) {
  PlantDevice device({}, kHand, glm::dvec3(0.0));
  double now = 0;
  Hold(device, now, 10, {1, 0, 0}, false);
  Hold(device, now, 10, {1, 0, 0}, true);
  ASSERT_EQ(device.force().x, 1);
  device.SetSilent(true);
  double without_force = 0, lost = 0;
  for (int i = 1; i <= 30; ++i) {
    Hold(device, now, 1, {1, 0, 0}, true);
    if (without_force == 0 && device.force().x == 0) without_force = i * kTick;
    if (lost == 0 && device.state() == DeviceState::kLost) lost = i * kTick;
  }
  EXPECT_LE(without_force, 0.006);
  EXPECT_NEAR(lost, 0.0205, 0.00051) << "the tick at 20 ms or the one after it";
  device.SetSilent(false);
  Hold(device, now, 10, {1, 0, 0}, true);
  EXPECT_EQ(device.force(), glm::dvec3(0.0)) << "it must be let go first";
}

TEST(PlantDevice, ANaNForceIsAFaultAndGivesNoForce) {
  PlantDevice device({}, kHand, glm::dvec3(0.0));
  double now = 0;
  Hold(device, now, 10, {0, 0, 0}, false);
  Hold(device, now, 2, {1, 0, 0}, true);
  ASSERT_EQ(device.force().x, 1);
  Hold(device, now, 1, {0, std::nan(""), 0}, true);
  EXPECT_EQ(device.force(), glm::dvec3(0.0));
  Hold(device, now, 1, {1, 0, 0}, true);
  EXPECT_EQ(device.state(), DeviceState::kFault);
  EXPECT_EQ(device.status().reason, DeviceTrouble::kNotFinite);
  EXPECT_EQ(device.force(), glm::dvec3(0.0));
}

TEST(PlantDevice, IsAbsentWhileUnplugged) {
  PlantDevice device({}, kHand, glm::dvec3(0.0));
  double now = 0;
  Hold(device, now, 10, {0, 0, 0}, false);
  device.SetPlugged(false);
  EXPECT_FALSE(Hold(device, now, 1, {1, 0, 0}, true).valid);
  EXPECT_EQ(device.state(), DeviceState::kLost);
  Hold(device, now, 3, {1, 0, 0}, true);
  EXPECT_EQ(device.state(), DeviceState::kAbsent);
  device.SetPlugged(true);
  Hold(device, now, 5, {1, 0, 0}, false);
  EXPECT_EQ(device.state(), DeviceState::kReady);
}

TEST(PlantDevice, ATickAllocatesNothing) {
  PlantDevice device({}, kHand, glm::dvec3(0.0));
  double now = 0;
  const long before = test::Allocations();
  Hold(device, now, 100, {1, 0, 0}, false);
  Hold(device, now, 100, {1, 0, 0}, true);
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace arthro::simulation
