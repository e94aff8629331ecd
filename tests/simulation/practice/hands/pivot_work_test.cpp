// A running calibration (simulation/practice/hands/pivot_work.h), fed with a hand of known incision
// at 1 kHz, rounded to the quantum of a Touch-class device.
#include "simulation/practice/hands/pivot_work.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {
namespace {

constexpr double kQuantum = 0.055e-3;  // m
const DeviceRig kRig{{0.012, -0.034, 0.11}, {1, 0, 0, 0}, 0.2};

struct Hand {
  explicit Hand(PivotWork& own) : work(own) {}
  // Stays there for `seconds`.
  void Rest(const RodPose& pose, double seconds, std::uint32_t buttons = 0) {
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) Say(pose, buttons);
  }
  void Say(const RodPose& pose, std::uint32_t buttons = 0) {
    DeviceSample sample;
    sample.t = t += 1e-3;
    sample.hip_in_device = kQuantum * glm::round(HipFromRodPose(pose, kRig) / kQuantum);
    sample.handle_in_device = HandleFromRodPose(pose, kRig);
    sample.buttons = buttons;
    sample.valid = true;
    work.Take(sample);
  }
  PivotWork& work;
  double t = 5;
};

DeviceCaps Caps() {
  DeviceCaps caps;
  caps.position_quantum = kQuantum;
  return caps;
}

RodPose Tilted(double degrees) { return {0.1, RadiansFromDegrees(degrees), 0.2, 0.05}; }

double ErrorOf(const PivotWork& work) { return glm::distance(*work.found().pivot, kRig.pivot); }

TEST(PivotWork, TwoPressesFindTheIncisionWithinThreeSigma) {
  PivotWork work(kRig.rod_length, PivotOptionsOf(Caps()));
  Hand hand(work);
  hand.Rest(Tilted(0), 0.2, 1);
  EXPECT_FALSE(work.pressing()) << "held from the beginning on";
  hand.Rest(Tilted(0), 0.05);
  hand.Rest(Tilted(0), 0.05, 1);
  ASSERT_TRUE(work.pressing());
  EXPECT_NEAR(*work.pressing(), 0.5, 0.02);
  EXPECT_FALSE(work.MayBeUsed());
  hand.Rest(Tilted(0), 0.2, 1);
  EXPECT_EQ(work.poses().size(), 1u) << "once a press, however long it is held";
  EXPECT_EQ(work.found().status, PivotStatus::kTooFew);
  hand.Rest(Tilted(20), 0.1);
  EXPECT_NEAR(DegreesFromRadians(work.angle()), 20, 0.2) << "of the rod as it is now";
  hand.Rest(Tilted(35), 0.1);
  hand.Rest(Tilted(35), 0.2, 2);
  ASSERT_EQ(work.poses().size(), 2u);
  EXPECT_EQ(work.found().status, PivotStatus::kOk) << work.found().reason;
  EXPECT_TRUE(work.MayBeUsed());
  EXPECT_LT(work.found().sigma, 0.1e-3);
  EXPECT_LT(ErrorOf(work), 3 * work.found().sigma);
  work.Begin();
  EXPECT_EQ(work.poses().size(), 0u);
  EXPECT_FALSE(work.MayBeUsed());
}

TEST(PivotWork, RefusesANarrowPairAndAMovingHandWithAReason) {
  PivotWork work(kRig.rod_length, PivotOptionsOf(Caps()));
  Hand hand(work);
  hand.Rest(Tilted(0), 0.05);
  work.Press();
  hand.Rest(Tilted(0), 0.2);
  work.Press();
  for (int i = 0; i < 200; ++i) hand.Say(Tilted(3.0 + 0.01 * i));
  EXPECT_NE(work.refusal().find("the hand moved"), std::string::npos) << work.refusal();
  EXPECT_EQ(work.poses().size(), 1u) << "it does not count";
  work.Press();
  hand.Rest(Tilted(5), 0.2);
  EXPECT_EQ(work.refusal(), "");
  EXPECT_EQ(work.found().status, PivotStatus::kTooNarrow);
  EXPECT_NE(work.found().reason.find("degrees"), std::string::npos);
  EXPECT_FALSE(work.MayBeUsed());
  // A third press at a larger angle makes it usable.
  work.Press();
  hand.Rest(Tilted(-35), 0.2);
  EXPECT_TRUE(work.MayBeUsed()) << work.found().reason;
  EXPECT_LT(ErrorOf(work), 3 * work.found().sigma);

  work.Press();
  work.Take(DeviceSample{});
  EXPECT_NE(work.refusal().find("did not say"), std::string::npos) << work.refusal();
  EXPECT_TRUE(work.MayBeUsed()) << "the presses before stand";
}

TEST(PivotWork, WarnsOfAWrongRodLengthAndAllowsIt) {
  PivotWork work(0.10, PivotOptionsOf(Caps()));  // the incision is 0.15 m from the hand
  Hand hand(work);
  for (const double degrees : {0.0, 35.0}) {
    hand.Rest(Tilted(degrees), 0.05);
    work.Press();
    hand.Rest(Tilted(degrees), 0.2);
  }
  EXPECT_EQ(work.found().status, PivotStatus::kOutsideRod);
  EXPECT_TRUE(work.MayBeUsed());
  EXPECT_LT(ErrorOf(work), 3 * work.found().sigma) << "the number is right";
}

TEST(PivotWork, FitsASwingFourTimesPerSecond) {
  PivotWork work(kRig.rod_length, PivotOptionsOf(Caps()));
  work.Begin(PivotSource::kSwing);
  Hand hand(work);
  int fits = 0;
  std::optional<PivotFit> old;
  for (int i = 0; i < 10000; ++i) {
    const double t = 1e-3 * i;
    hand.Say({0.35 * std::sin(2.1 * t), 0.35 * std::sin(1.3 * t), 0, 0.06}, i % 100 == 0);
    if (auto fit = work.DueFit()) {
      EXPECT_FALSE(work.DueFit()) << "once";
      work.TakeFit(*fit, fit->Found());
      old = fit;
      ++fits;
    }
  }
  EXPECT_GE(fits, 38);
  EXPECT_LE(fits, 41);
  EXPECT_FALSE(work.pressing()) << "a button is no press of a swing";
  EXPECT_EQ(work.found().status, PivotStatus::kOk) << work.found().reason;
  EXPECT_LT(ErrorOf(work), 3 * work.found().sigma);
  EXPECT_GT(DegreesFromRadians(work.angle()), 30);
  // A fit that returns after a new beginning is ignored.
  work.Begin();
  work.TakeFit(*old, old->Found());
  EXPECT_FALSE(work.MayBeUsed());
  EXPECT_EQ(work.found().status, PivotStatus::kTooFew);
  EXPECT_NE(work.found().reason.find("keep swinging"), std::string::npos) << work.found().reason;
}

// Stated noise changes the result at once.
TEST(PivotWork, UsesTheStatedNoiseOfTheHandle) {
  DeviceCaps caps = Caps();
  caps.gimbal_sigma = RadiansFromDegrees(0.1);
  PivotWork work(kRig.rod_length, PivotOptionsOf(caps));
  EXPECT_EQ(work.options().angle_noise, caps.gimbal_sigma);
  EXPECT_NEAR(work.options().position_noise, kQuantum / std::sqrt(12.0), 1e-12);
  Hand hand(work);
  for (const double degrees : {0.0, 35.0}) {
    hand.Rest(Tilted(degrees), 0.05);
    work.Press();
    hand.Rest(Tilted(degrees), 0.2);
  }
  EXPECT_TRUE(work.MayBeUsed());
  const double sigma = work.found().sigma;
  work.SetAngleNoise(RadiansFromDegrees(2));
  EXPECT_FALSE(work.MayBeUsed());
  EXPECT_GT(work.found().sigma, 10 * sigma);
}

}  // namespace
}  // namespace arthro::simulation
