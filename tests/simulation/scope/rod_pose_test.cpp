// Hard cases: HAP in resources/doc/hard-cases.md.
#include "simulation/scope/rod_pose.h"

#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/scope/test_rigs.h"

namespace arthro::simulation {
namespace {

using test::TiltedRig;

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

TEST(RodPose, HardCase22InAndOutLeavesTheAngles) {
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

// Roll crosses 180 degrees without a jump.
TEST(RodPose, HardCase21RollIsContinuousOverSeveralTurns) {
  const DeviceRig rig;
  RodPose previous{0.1, 0.2, 0.0, 0.02};
  for (double roll = 0.0; roll < 20.0; roll += 0.1) {
    const RodPose pose{0.1, 0.2, roll, 0.02};
    previous =
        RodPoseFromHip(HipFromRodPose(pose, rig), HandleFromRodPose(pose, rig), rig, previous);
    ASSERT_NEAR(previous.roll, roll, 1e-9);
  }
}

// Hardest case: beside the pole an arc sine would lose half of the digits.
TEST(RodPose, HardCase22InAndOutLeavesTheAnglesBesideThePole) {
  const DeviceRig rig;
  for (double from_pole : {1e-3, 1e-5, 1e-7, 1e-8}) {
    const glm::dvec3 u(0.0, -std::cos(from_pole), std::sin(from_pole));
    const auto latitude = [&](double hand) {
      return RodPoseFromHip(-hand * u, {1, 0, 0, 0}, rig).latitude;
    };
    for (double hand = 0.05; hand < 0.2; hand += 0.0037)
      EXPECT_NEAR(latitude(hand), std::numbers::pi / 2 - from_pole, 1e-9) << from_pole;
  }
}

TEST(RodPose, HardCase15LeverIsFiniteAtEveryHandAndOnBothSidesOfThePivot) {
  const DeviceRig rig = TiltedRig();
  const glm::dvec3 along = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  RodPose pose;
  for (double hand : {0.6, 0.25 + 1e-12, 0.25, 0.25 - 1e-12, 0.1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-300,
                      0.0, -1e-300, -1e-9, -1e-3, -0.1, -0.25, -0.6}) {
    pose = RodPoseFromHip(rig.pivot - hand * along, {1, 0, 0, 0}, rig, pose);
    EXPECT_NEAR(pose.depth, 0.25 - std::abs(hand), 1e-12);
    const RodBasis basis = BasisOf(pose);
    EXPECT_NEAR(glm::length(basis.axis), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(basis.axis, basis.north), 0.0, 1e-12);
    EXPECT_TRUE(std::isfinite(pose.roll));
    if (std::abs(hand) >= 1e-3) {
      const glm::dvec3 u = rig.portal_from_device * (hand > 0 ? along : -along);
      EXPECT_LT(glm::length(basis.axis - u), 1e-12) << hand;
    }
  }
}

// A resting hand at the pivot has sensor noise; using its direction would turn the scope around in
// every tick.
TEST(RodPose, NoiseOnAHandAtThePivotDoesNotTurnTheRod) {
  const DeviceRig rig = TiltedRig();
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.055e-3);  // m, noise of a Touch-class encoder
  RodPose pose{0.3, -0.5, 0.7, 0.01};
  for (int tick = 0; tick < 2000; ++tick) {
    const glm::dvec3 hip = rig.pivot + glm::dvec3(noise(random), noise(random), noise(random));
    pose = RodPoseFromHip(hip, HandleFromRodPose(pose, rig), rig, pose);
    ASSERT_EQ(pose.latitude, 0.3) << "tick " << tick;
    ASSERT_EQ(pose.longitude, -0.5);
  }
}

TEST(RodPose, HandleNeedNotBeOfUnitLength) {
  const DeviceRig rig = TiltedRig();
  const RodPose pose{0.3, -0.5, 0.7, 0.01};
  for (double scale : {0.5, 0.9999, 3.0})
    EXPECT_NEAR(
        RodPoseFromHip(HipFromRodPose(pose, rig), scale * HandleFromRodPose(pose, rig), rig).roll,
        0.7, 1e-9);
}

TEST(RodPose, SampleThatIsNotANumberLeavesThePose) {
  const DeviceRig rig;
  const RodPose previous{0.3, -0.5, 0.7, 0.01};
  const glm::dquat handle = HandleFromRodPose(previous, rig);
  for (double bad : {std::nan(""), static_cast<double>(INFINITY), 1e300}) {
    const RodPose pose = RodPoseFromHip({0.0, bad, 0.0}, handle, rig, previous);
    EXPECT_EQ(pose.latitude, 0.3);
    EXPECT_EQ(pose.depth, 0.01);
    const RodPose turned =
        RodPoseFromHip(HipFromRodPose(previous, rig), {bad, 0, 0, 0}, rig, previous);
    EXPECT_NEAR(turned.latitude, 0.3, 1e-12);
    EXPECT_TRUE(std::isfinite(turned.roll));
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

TEST(RodPose, ToolLiesAlongItsRodWithItsHookNorthAtNoRoll) {
  const glm::dvec3 portal(0.03, 0.0, 0.0), tip(0.03, -0.01, 0.04);
  for (const double roll : {0.0, 0.5 * std::numbers::pi}) {
    const Rigid3 tool = PortalFromTool(portal, tip, roll);
    EXPECT_EQ(tool.translation, tip);
    const glm::dvec3 along = tool.rotation * glm::dvec3(0, 0, 1);
    EXPECT_NEAR(glm::distance(along, glm::normalize(tip - portal)), 0.0, 1e-15);
    const glm::dvec3 hook = tool.rotation * glm::dvec3(0, 1, 0);
    // North is up (-y), perpendicular to the rod; east is right.
    EXPECT_NEAR(roll == 0.0 ? -hook.y : hook.x, roll == 0.0 ? along.z : 1.0, 1e-12);
  }
  EXPECT_TRUE(std::isfinite(PortalFromTool(portal, portal, 0.3).rotation.w)) << "no rod at all";
}

}  // namespace
}  // namespace arthro::simulation
