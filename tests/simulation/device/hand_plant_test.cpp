#include "simulation/device/hand_plant.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;

PlantOptions Ideal(int delay = 0) { return {0.045, 0.2, 0, 0, 1e9, delay}; }

TEST(HandPlant, AFreeDeviceFollowsTheExactSolution) {
  HandPlant plant(Ideal(), kNoHand, glm::dvec3(0.0));
  const double force = 0.5, rate = 0.2 / 0.045;
  for (int i = 0; i < 200; ++i) plant.Tick({force, 0, 0}, kTick);
  const double t = 0.2, end = force / 0.2;
  EXPECT_NEAR(plant.velocity().x, end * (1 - std::exp(-rate * t)), 1e-9);
  EXPECT_NEAR(plant.position().x, end * (t - (1 - std::exp(-rate * t)) / rate), 1e-9);
}

TEST(HandPlant, WorkIsTheEnergyOfTheHand) {
  PlantOptions options = Ideal();
  options.damping = 0;
  HandPlant plant(options, kNoHand, glm::dvec3(0.0));
  for (int i = 0; i < 100; ++i) plant.Tick({0.3, -0.1, 0.2}, kTick);
  const double kinetic = 0.5 * 0.045 * glm::dot(plant.velocity(), plant.velocity());
  EXPECT_NEAR(plant.work(), kinetic, 1e-12);
}

TEST(HandPlant, CommandsActAfterTheirDelay) {
  for (const int delay : {0, 1, 2, 5}) {
    HandPlant plant(Ideal(delay), kNoHand, glm::dvec3(0.0));
    int ticks = 0;
    while (plant.position().x == 0 && ticks < 20) plant.Tick({1, 0, 0}, kTick), ++ticks;
    EXPECT_EQ(ticks, delay + 1);
  }
}

TEST(HandPlant, FrictionHoldsAgainstASmallerForce) {
  HandPlant plant({}, kNoHand, glm::dvec3(0.0));
  for (int i = 0; i < 1000; ++i) plant.Tick({0.2, 0.1, 0}, kTick);
  EXPECT_EQ(plant.position(), glm::dvec3(0.0)) << "0.22 N against 0.26";
  for (int i = 0; i < 100; ++i) plant.Tick({0.3, 0, 0}, kTick);
  EXPECT_GT(plant.position().x, 0.0);
  plant.SetVelocity({0, 0.1, 0});
  for (int i = 0; i < 200; ++i) plant.Tick({0, 0, 0}, kTick);
  EXPECT_EQ(plant.velocity(), glm::dvec3(0.0)) << "and stops what nobody pushes";
}

TEST(HandPlant, AHandReachesItsIntent) {
  for (const HandModel& hand : {kSoftHand, kHand, kStiffHand, kWholeArm}) {
    HandPlant plant(Ideal(), hand, glm::dvec3(0.0));
    plant.SetIntent({0.02, 0, -0.01});
    for (int i = 0; i < 4000; ++i) plant.Tick(glm::dvec3(0.0), kTick);
    EXPECT_LT(glm::distance(plant.position(), glm::dvec3(0.02, 0, -0.01)), 1e-6) << hand.stiffness;
    for (int i = 0; i < 4000; ++i) plant.Tick({0, 0.5, 0}, kTick);
    EXPECT_NEAR(plant.position().y, 0.5 / hand.stiffness, 1e-6) << "gives way by its stiffness";
  }
}

TEST(HandPlant, ReportsPositionsInWholeQuanta) {
  PlantOptions options;
  options.quantum = 1e-4;
  HandPlant plant(options, kHand, {1.26e-3, 0, -0.4e-4});
  EXPECT_LT(glm::distance(plant.Sample().hip_in_device, glm::dvec3(13e-4, 0, 0)), 1e-15);
  EXPECT_TRUE(plant.Sample().valid);
}

TEST(HandPlant, IgnoresNaNAndClampsToThePeak) {
  HandPlant plant(Ideal(), kNoHand, glm::dvec3(0.0));
  plant.Tick({std::nan(""), 0, 0}, kTick);
  plant.Tick({0, std::numeric_limits<double>::infinity(), 0}, kTick);
  EXPECT_EQ(plant.position(), glm::dvec3(0.0));
  PlantOptions weak = Ideal();
  weak.peak_force = 1;
  HandPlant a(weak, kNoHand, glm::dvec3(0.0)), b(weak, kNoHand, glm::dvec3(0.0));
  a.Tick({0, 1e6, 0}, kTick), b.Tick({0, 1, 0}, kTick);
  EXPECT_NEAR(a.velocity().y, b.velocity().y, 1e-15);
}

}  // namespace
}  // namespace arthro::simulation
