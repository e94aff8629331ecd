// A hand swings the rod through an incision of known position. Hard cases: HAP in
// resources/doc/hard-cases.md.
#include "simulation/scope/pivot_swing.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/core/units.h"
#include "simulation/scope/rod_pose.h"
#include "tests/simulation/scope/test_rigs.h"

namespace arthro::simulation {
namespace {

constexpr double kQuantum = 0.055e-3;                   // m, quantum of a Touch-class device
constexpr double kAngleNoise = 0.1 * kRadianPerDegree;  // rad; encoders of 0.35° per count
using test::kStraightRig;

struct Sample {
  glm::dvec3 hip{0.0};
  glm::dquat handle{1, 0, 0, 0};
};

// Pose at time t of a swing by 20° either way and 40 mm in and out, exact or with sensor noise.
RodPose PoseAt(double t) {
  return {0.35 * std::sin(2.1 * t), 0.35 * std::sin(1.3 * t), 0.5 * t,
          0.08 + 0.02 * std::sin(0.7 * t)};
}
Sample Exact(const RodPose& pose, const DeviceRig& rig = kStraightRig) {
  return {HipFromRodPose(pose, rig), HandleFromRodPose(pose, rig)};
}
Sample Sensed(const RodPose& pose, Random& random, const DeviceRig& rig = kStraightRig) {
  Sample sample = Exact(pose, rig);
  sample.hip = kQuantum * glm::round(sample.hip / kQuantum);
  const double even = kAngleNoise * std::sqrt(3.0);  // half width of uniform noise with that rms
  const glm::dvec3 turn(random.Uniform(-even, even), random.Uniform(-even, even), 0);
  sample.handle = sample.handle * glm::dquat(1, turn.x / 2, turn.y / 2, 0);
  return sample;
}

PivotOptions Options() {
  PivotOptions options;
  options.position_noise = kQuantum / std::sqrt(12.0);
  options.angle_noise = kAngleNoise;
  return options;
}

TEST(PivotSwing, PressOfASampleIsItsRod) {
  const RodPose pose{0.3, -0.2, 1.1, 0.05};
  const Sample sample = Exact(pose);
  const PivotPress press = PressOf(sample.hip, sample.handle, kStraightRig.rod_length);
  EXPECT_LT(glm::length(press.tip - (kStraightRig.pivot + TipInOwnPortal(pose))), 1e-15);
}

// Target: within 3 sigma in 99 of 100 trials.
TEST(PivotSwing, ASwingOfTwentySecondsFindsTheIncisionWithinThreeSigma) {
  int within = 0;
  double largest = 0, sigma = 0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(trial));
    PivotSwing swing(kStraightRig.rod_length);
    for (int i = 0; i < 20000; ++i) {
      const Sample sample = Sensed(PoseAt(7.0 * trial + 1e-3 * i), random);
      swing.Add(sample.hip, sample.handle);
    }
    const PivotCalibration found = CalibratePivot(swing.presses(), Options());
    ASSERT_EQ(found.status, PivotStatus::kOk) << found.reason;
    const double error = glm::length(*found.pivot - kStraightRig.pivot);
    within += error <= 3 * found.sigma;
    largest = std::max(largest, error);
    sigma = found.sigma;
  }
  std::printf("%d of %d within 3 sigma; sigma %.3f mm, largest error %.3f mm\n", within, kTrials,
              1e3 * sigma, 1e3 * largest);
  EXPECT_GE(within, 99);
}

// The trocar slips by 20 mm during one of twenty seconds.
TEST(PivotSwing, HardCase20LeavesOutATemporarySlip) {
  Random random(1);
  PivotSwing swing(kStraightRig.rod_length);
  DeviceRig slipped = kStraightRig;
  slipped.pivot += glm::dvec3(0.02, 0, 0);
  for (int i = 0; i < 20000; ++i) {
    const bool slips = i >= 9000 && i < 10000;
    const Sample sample = Sensed(PoseAt(1e-3 * i), random, slips ? slipped : kStraightRig);
    swing.Add(sample.hip, sample.handle);
  }
  const PivotCalibration found = CalibratePivot(swing.presses(), Options());
  ASSERT_EQ(found.status, PivotStatus::kOk) << found.reason;
  EXPECT_FALSE(found.left_out.empty());
  EXPECT_LT(glm::length(*found.pivot - kStraightRig.pivot), 3 * found.sigma);
}

TEST(PivotSwing, ARestingHandCountsOnce) {
  Random random(1);
  PivotSwing swing(kStraightRig.rod_length);
  for (int i = 0; i < 5000; ++i) {
    const Sample sample = Sensed(PoseAt(0.4), random);
    EXPECT_EQ(swing.Add(sample.hip, sample.handle), i == 0);
  }
  EXPECT_EQ(CalibratePivot(swing.presses(), Options()).status, PivotStatus::kTooFew);
}

// For any number of poses.
TEST(PivotSwing, HardCase16InAndOutAloneIsRefused) {
  Random random(1);
  PivotSwing swing(kStraightRig.rod_length);
  for (int i = 0; i < 5000; ++i) {
    const Sample sample = Sensed({0.1, 0.2, 0, 0.08 + 0.03 * std::sin(1e-3 * i)}, random);
    swing.Add(sample.hip, sample.handle);
  }
  EXPECT_GT(swing.presses().size(), 50u);
  EXPECT_EQ(CalibratePivot(swing.presses(), Options()).status, PivotStatus::kTooNarrow);
}

// A swing has no presses.
TEST(PivotSwing, EverySentenceRefersToPoses) {
  const auto reason_of = [](const std::vector<PivotPress>& poses, PivotStatus status) {
    const PivotCalibration found = CalibratePivot(poses, {}, PivotSource::kSwing);
    EXPECT_EQ(found.status, status) << found.reason;
    return found.reason;
  };
  const auto poses_of = [](double width, double reach, double moved = 0) {
    std::vector<PivotPress> poses;
    for (int i = 0; i < 30; ++i) {
      const Sample sample = Exact({width * std::sin(0.7 * i), width * std::cos(0.9 * i), 0, 0});
      const PivotPress press = PressOf(sample.hip, sample.handle, reach);
      const glm::dvec3 off = i % 2 == 0 ? glm::dvec3(0) : moved * glm::dvec3(1, 1, 1);
      poses.push_back({press.hip + off, press.tip + off});
    }
    return poses;
  };
  std::vector<PivotPress> one = poses_of(0.4, 0.2), slipped = poses_of(0.4, 0.25);
  one.resize(1);
  slipped[3].hip.x += 0.05;
  for (const std::string& reason :
       {reason_of(one, PivotStatus::kTooFew),
        reason_of(poses_of(0.01, 0.2), PivotStatus::kTooNarrow),
        reason_of(poses_of(0.4, 0.25, 0.02), PivotStatus::kInconsistent),
        reason_of(poses_of(0.4, 0.1), PivotStatus::kOutsideRod),
        reason_of(slipped, PivotStatus::kOk)}) {
    EXPECT_FALSE(reason.empty());
    EXPECT_EQ(reason.find("press"), std::string::npos) << reason;
  }
}

TEST(PivotSwing, ALongSwingIsThinnedAndStillCoversItsBeginning) {
  PivotSwing swing(kStraightRig.rod_length);
  const Sample first = Exact(PoseAt(0));
  for (int i = 0; i < 200000; ++i) {
    const Sample sample = Exact(PoseAt(1e-3 * i));
    swing.Add(sample.hip, sample.handle);
    ASSERT_LE(swing.presses().size(), 2000u);
  }
  EXPECT_GT(swing.presses().size(), 900u);
  EXPECT_EQ(swing.presses().front().hip, first.hip);
  EXPECT_FALSE(swing.Add(glm::dvec3(std::numeric_limits<double>::quiet_NaN()), {1, 0, 0, 0}));
  EXPECT_FALSE(swing.Add({0, 0, 0}, {0, 0, 0, 0})) << "no direction";
}

}  // namespace
}  // namespace arthro::simulation
