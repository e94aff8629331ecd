#include "simulation/scope/rod_pose.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

DeviceRig TiltedRig() {
  DeviceRig rig;
  rig.pivot = {0.01, -0.02, 0.15};
  rig.portal_from_device = glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2));
  rig.rod_length = 0.25;
  return rig;
}

TEST(RodPose, RoundTripsThroughTheHand) {
  for (const DeviceRig& rig : {DeviceRig{}, TiltedRig()})
    for (double latitude : {-1.3, -0.2, 0.0, 0.9})
      for (double longitude : {-2.8, -0.4, 0.0, 1.9})
        for (double roll : {-1.0, 0.0, 2.5}) {
          const RodPose pose{latitude, longitude, roll, 0.03};
          const RodPose back =
              RodPoseFromHip(HipFromRodPose(pose, rig), HandleFromRodPose(pose, rig), rig, pose);
          EXPECT_NEAR(back.latitude, latitude, 1e-9);
          EXPECT_NEAR(back.longitude, longitude, 1e-9);
          EXPECT_NEAR(back.roll, roll, 1e-9);
          EXPECT_NEAR(back.depth, 0.03, 1e-12);
        }
}

TEST(RodPose, IdentityHandleHasNoRoll) {
  const DeviceRig rig;
  const RodPose pose = RodPoseFromHip({0, 0, -0.17}, {1, 0, 0, 0}, rig);
  EXPECT_NEAR(pose.roll, 0.0, 1e-12);
  EXPECT_NEAR(pose.depth, 0.03, 1e-12);
  EXPECT_LT(glm::length(TipInOwnPortal(pose) - glm::dvec3(0, 0, 0.03)), 1e-12);
}

// Notes, hard case 22.
TEST(RodPose, InAndOutLeavesTheAngles) {
  const DeviceRig rig = TiltedRig();
  const RodPose pose{0.3, -0.5, 0.0, 0.01};
  const glm::dvec3 hip = HipFromRodPose(pose, rig);
  const glm::dvec3 along = glm::normalize(rig.pivot - hip);
  for (double step = 0.0; step < 0.1; step += 0.005) {
    const RodPose moved = RodPoseFromHip(hip + step * along, HandleFromRodPose(pose, rig), rig);
    EXPECT_NEAR(moved.latitude, 0.3, 1e-9);
    EXPECT_NEAR(moved.longitude, -0.5, 1e-9);
    EXPECT_NEAR(moved.depth, 0.01 + step, 1e-12);
  }
}

// Notes, hard case 21: roll crosses 180 degrees without a jump.
TEST(RodPose, RollIsContinuousOverSeveralTurns) {
  const DeviceRig rig;
  RodPose previous{0.1, 0.2, 0.0, 0.02};
  for (double roll = 0.0; roll < 20.0; roll += 0.1) {
    const RodPose pose{0.1, 0.2, roll, 0.02};
    previous =
        RodPoseFromHip(HipFromRodPose(pose, rig), HandleFromRodPose(pose, rig), rig, previous);
    ASSERT_NEAR(previous.roll, roll, 1e-9);
  }
}

TEST(RodPose, HandOnThePivotKeepsTheLastDirection) {
  const DeviceRig rig;
  const RodPose previous{0.3, -0.5, 0.7, 0.01};
  const RodPose pose = RodPoseFromHip(rig.pivot, HandleFromRodPose(previous, rig), rig, previous);
  EXPECT_EQ(pose.latitude, previous.latitude);
  EXPECT_EQ(pose.longitude, previous.longitude);
  EXPECT_NEAR(pose.depth, rig.rod_length, 1e-12);
}

}  // namespace
}  // namespace arthro::simulation
