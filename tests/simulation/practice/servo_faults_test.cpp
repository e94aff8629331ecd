// Servo loop after faults: late ticks, lost devices, released dead-men, moved mounts. None may push
// the hand. Hard cases: HAP in resources/doc/hard-cases.md.
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/practice/servo_bench.h"

namespace arthro::simulation {
namespace {

TEST(ServoLoop, HardCase7ArmedInsideAWallTheHandIsPushedOutOverHalfASecond) {
  Servo servo;
  servo.Tick(3000);
  servo.HoldDeadMan(true);
  double peak = 0;
  for (int i = 0; i < 700; ++i) {
    servo.Tick();
    const double force = glm::length(servo.scope.force());
    ASSERT_LE(force, 500 * kDepth * std::min(1.0, (i + 1) * kTick / 0.5) + 1e-9) << i;
    peak = std::max(peak, force);
  }
  EXPECT_GT(peak, 0.05);
}

// Sets a calibrated pivot while the device is armed and its tip in a wall, which changes the depth
// at once. The device is then pushed as one that is armed there.
TEST(ServoLoop, HardCase7AMountThatChangesUnderAnArmedDeviceRampsAndDoesNotKick) {
  for (const double deeper : {3e-3, -0.5e-3, 0.05, 0.2}) {  // m; the last is beyond the hand
    Servo servo;
    servo.Arm();
    servo.Tick(1000);
    ASSERT_GT(glm::length(servo.scope.force()), 0.05);
    DeviceRig mount = servo.session.scope_rig();
    mount.pivot += glm::conjugate(mount.portal_from_device) * glm::dvec3(0, 0, -deeper);
    servo.request.mount[0] = mount;
    servo.HoldDeadMan(true);
    servo.Tick();
    EXPECT_EQ(servo.scope.force(), glm::dvec3(0.0)) << "in the tick of the change";
    EXPECT_EQ(servo.session.scope_rig(), mount);
    glm::dvec3 before(0.0);
    double peak = 0;
    for (int i = 0; i < 700; ++i) {
      servo.Tick();
      EXPECT_EQ(servo.scope.state(), DeviceState::kArmed);
      const glm::dvec3 force = servo.scope.force();
      // Bounds: the force of the spring over half a second, and the peak of the device at 300 N/s.
      const double whole = std::min(3.3, 500 * (kDepth + std::max(0.0, deeper)));
      ASSERT_LE(glm::length(force), whole * std::min(1.0, (i + 1) * kTick / 0.5) + 1e-9)
          << i << " ms after " << deeper;
      ASSERT_LE(glm::length(force) - glm::length(before), 300 * kTick + 1e-9) << i;
      before = force;
      peak = std::max(peak, glm::length(force));
    }
    if (deeper > 0 && deeper < 0.1) {
      EXPECT_GT(peak, 0.5) << "and it is pushed again";
    }
    // Setting the same mount again changes nothing.
    servo.HoldDeadMan(true);
    servo.Tick();
    EXPECT_EQ(servo.loop.ReadSnapshot().scope.fault, Fault::kNone);
  }
}

// Touches the wall at 2 Hz and compares the work of the force on the hand.
class HardCase12 : public testing::TestWithParam<int> {};
TEST_P(HardCase12, ALateTickGivesNoEnergyAndUsesTheTrueTimeStep) {
  const int late = GetParam();  // ms
  double given[2];
  for (const bool is_late : {false, true}) {
    Servo servo({}, {0.045, 0.2, 0, 5.5e-5, 3.3, 1});
    servo.Arm();
    const glm::dvec3 rest = servo.scope.plant().position();
    // Largest energy given between any two moments of a run, minus that of a servo without late
    // ticks.
    double lowest = servo.scope.plant().work(), most = 0;
    for (int i = 0; i < 3000; ++i) {
      const double s = std::sin(4 * 3.14159265358979 * i * kTick);
      servo.scope.plant().SetIntent(rest + glm::dvec3(0, 0, 1e-3 + 2e-3 * s));
      const bool is_now = is_late && i % 97 == 50;
      const double before = servo.session.snapshot().t;
      servo.Tick(1, is_now ? kTick * (1 + late) : kTick);
      if (is_now) {
        EXPECT_NEAR(servo.session.snapshot().t - before, kTick * (1 + late), 1e-12);
        if (late > 3) {
          EXPECT_EQ(servo.scope.force(), glm::dvec3(0.0));
        }
      }
      const double work = servo.scope.plant().work();
      lowest = std::min(lowest, work);
      most = std::max(most, work - lowest);
    }
    given[is_late] = servo.scope.plant().work();
    if (is_late) {
      servo.Tick(100);
      const ServoReport report = servo.loop.ReadReport();
      EXPECT_EQ(report.missed, 31L * late);
      EXPECT_EQ(report.overruns, late > 3 ? 31 : 0);
    }
  }
  std::printf("%2d ms late, 31 times: work on the hand %.3f mJ, on time %.3f mJ\n", late,
              1e3 * given[1], 1e3 * given[0]);
  EXPECT_LT(given[1] - given[0], 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Lateness, HardCase12, testing::Values(1, 3, 25));

TEST(ServoLoop, ATickMoreThanThreePeriodsLateGivesNoForceOnce) {
  Servo servo;
  servo.Arm();
  const double before = glm::length(servo.scope.force());
  ASSERT_GT(before, 0.1);
  servo.Tick(1, 4 * kTick);
  EXPECT_GT(glm::length(servo.scope.force()), 0.0) << "three ticks late is not more than three";
  servo.Tick(1, 5 * kTick);
  EXPECT_EQ(servo.scope.force(), glm::dvec3(0.0));
  servo.Tick(1);
  EXPECT_GT(glm::length(servo.scope.force()), 0.0);
  EXPECT_EQ(servo.scope.state(), DeviceState::kArmed);
}

TEST(ServoLoop, ALostDeviceGetsNoForceBeforeSixMillisecondsAndIsLostBefore25) {
  Servo servo;
  servo.Arm();
  ASSERT_GT(glm::length(servo.scope.force()), 0.1);
  servo.scope.SetSilent(true);
  double without_force = 0, lost = 0;
  for (int i = 1; i <= 30; ++i) {
    servo.Tick();
    if (without_force == 0 && servo.scope.force() == glm::dvec3(0.0)) without_force = i * kTick;
    if (lost == 0 && servo.scope.state() == DeviceState::kLost) lost = i * kTick;
  }
  std::printf("silent: no force after %.0f ms, lost after %.0f ms\n", 1e3 * without_force,
              1e3 * lost);
  EXPECT_GT(without_force, 0.0);
  EXPECT_LT(without_force, 5.5e-3);  // less than six ticks
  EXPECT_GT(lost, 0.0);
  EXPECT_LT(lost, 25e-3);
}

TEST(ServoLoop, ZeroForceModeComputesForcesGivesNoneAndEndsWithARamp) {
  Servo servo;
  servo.Arm();
  ASSERT_GT(glm::length(servo.scope.force()), 0.1);
  servo.request.is_zero_force = true;
  servo.HoldDeadMan(true);
  for (int i = 0; i < 500; ++i) {
    servo.Tick();
    ASSERT_EQ(servo.scope.force(), glm::dvec3(0.0)) << i;
  }
  EXPECT_GT(glm::length(servo.loop.ReadSnapshot().scope.hand_force), 0.1) << "what it would feel";
  servo.HoldDeadMan(false);
  servo.Tick(700);
  EXPECT_GT(glm::length(servo.loop.ReadSnapshot().scope.hand_force), 0.1)
      << "nobody need be armed for it";
  servo.HoldDeadMan(true);
  servo.Tick(10);
  servo.request.is_zero_force = false;
  servo.HoldDeadMan(true);
  for (int i = 0; i < 500; ++i) {
    servo.Tick();
    ASSERT_LE(glm::length(servo.scope.force()), 500 * kDepth * i * kTick / 0.5 + 1e-9) << i;
  }
  EXPECT_GT(glm::length(servo.scope.force()), 0.1);
}

TEST(ServoLoop, IgnoresTheDeadManAfterRequestsHaveStopped) {
  ServoOptions options;
  options.request_lasts = 0.5;
  Servo servo(options);
  servo.scope.SetButtons(2);  // second button of the handle, held down
  servo.HoldDeadMan(false);
  servo.Tick(10);
  servo.scope.SetButtons(0);
  servo.Tick(10);
  servo.scope.SetButtons(2);
  servo.Tick(470);
  EXPECT_GT(glm::length(servo.scope.force()), 0.1);
  servo.Tick(20);  // 0.51 s after the request
  EXPECT_EQ(servo.scope.force(), glm::dvec3(0.0));
  EXPECT_EQ(servo.scope.state(), DeviceState::kReady);
  servo.HoldDeadMan(false);
  servo.Tick(300);
  EXPECT_GT(glm::length(servo.scope.force()), 0.1) << "it is back, and so is the force";
}

// A window that hangs releases nothing: a dead-man that is taped down still arms no device that was
// lost meanwhile or before.
TEST(ServoLoop, AHangingWindowIsNoReleaseOfTheDeadMan) {
  ServoOptions options;
  options.request_lasts = 0.1;
  Servo servo(options);
  servo.HoldDeadMan(false);
  servo.Tick(10);
  servo.HoldDeadMan(true);
  servo.Tick(90);
  ASSERT_EQ(servo.scope.state(), DeviceState::kArmed);
  servo.HoldDeadMan(true);
  servo.scope.SetPlugged(false);
  servo.Tick(40);
  servo.scope.SetPlugged(true);
  servo.Tick(40);
  ASSERT_EQ(servo.scope.state(), DeviceState::kReady);
  servo.Tick(200);  // without a request
  for (int i = 0; i < 10; ++i) {
    servo.HoldDeadMan(true);
    servo.Tick(60);
    ASSERT_EQ(servo.scope.state(), DeviceState::kReady) << i;
    ASSERT_EQ(servo.scope.force(), glm::dvec3(0.0)) << i;
  }
  servo.HoldDeadMan(false);
  servo.Tick(10);
  servo.HoldDeadMan(true);
  servo.Tick(50);
  EXPECT_EQ(servo.scope.state(), DeviceState::kArmed) << "after a release";
}

}  // namespace
}  // namespace arthro::simulation
