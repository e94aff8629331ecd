// Presses of a hand that rests, trembles, moves or is lost.
#include "simulation/scope/press_average.h"

#include <cmath>
#include <functional>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/scope/rod_pose.h"
#include "tests/simulation/scope/test_rigs.h"

namespace arthro::simulation {
namespace {

using test::kStraightRig;
const RodPose kPose{0.3, -0.2, 1.1, 0.05};

// Makes a press of a hand that is displaced by `moved` at each time.
PressAverage Pressed(const std::function<glm::dvec3(double)>& moved, double rate = 1000) {
  PressAverage press(kStraightRig.rod_length);
  for (int i = 0; i < 1000; ++i) {
    const double t = 7.0 + i / rate;
    if (press.Add(t, HipFromRodPose(kPose, kStraightRig) + moved(t - 7.0),
                  HandleFromRodPose(kPose, kStraightRig)))
      break;
  }
  return press;
}

TEST(PressAverage, ARestingHandGivesItsRodAtAnyRate) {
  for (const double rate : {4000.0, 1000.0, 250.0, 60.0}) {
    const PressAverage press = Pressed([](double) { return glm::dvec3(0); }, rate);
    ASSERT_TRUE(press.press()) << press.refusal();
    EXPECT_EQ(press.done(), 1.0);
    EXPECT_LT(glm::distance(press.press()->hip, HipFromRodPose(kPose, kStraightRig)), 1e-15);
    EXPECT_LT(glm::distance(press.press()->tip, kStraightRig.pivot + TipInOwnPortal(kPose)), 1e-14);
  }
}

// With a hundred samples, noise of 0.05 mm per axis is averaged to 0.005 mm; five times that occurs
// once in a million.
TEST(PressAverage, NoiseIsAveragedAway) {
  Random random(3);
  const auto noise = [&](double) {
    const double even = 0.05e-3 * std::sqrt(3.0);
    return glm::dvec3(random.Uniform(-even, even), random.Uniform(-even, even),
                      random.Uniform(-even, even));
  };
  const PressAverage press = Pressed(noise);
  ASSERT_TRUE(press.press()) << press.refusal();
  EXPECT_LT(glm::distance(press.press()->hip, HipFromRodPose(kPose, kStraightRig)), 0.025e-3 * 1.8);
}

// Uniform motion over a distance has a standard deviation of 1/√12 of it: 0.1 mm for 0.35 mm.
TEST(PressAverage, RefusesAHandThatMovesByMoreThanATenthOfAMillimetre) {
  const auto moving = [](double span) {
    return Pressed([=](double t) { return glm::dvec3(0, span * t / 0.1, 0); });
  };
  EXPECT_TRUE(moving(0.33e-3).press());
  const PressAverage refused = moving(0.36e-3);
  EXPECT_FALSE(refused.press());
  EXPECT_NE(refused.refusal().find("the hand moved by 0.1"), std::string::npos)
      << refused.refusal();
  EXPECT_NE(refused.refusal().find("press again"), std::string::npos);
}

TEST(PressAverage, RefusesASilentOrRarelyReportingDevice) {
  PressAverage press(kStraightRig.rod_length);
  EXPECT_FALSE(press.Add(0, {0, 0, 0}, {1, 0, 0, 0}));
  EXPECT_TRUE(press.Miss());
  EXPECT_FALSE(press.press());
  EXPECT_NE(press.refusal().find("did not say"), std::string::npos);
  EXPECT_NE(Pressed([](double) { return glm::dvec3(0); }, 20).refusal().find("only 3 times"),
            std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Pressed([=](double t) { return glm::dvec3(t > 0.05 ? nan : 0); }).press());
}

}  // namespace
}  // namespace arthro::simulation
