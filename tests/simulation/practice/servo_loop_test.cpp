// Servo loop with simulated devices, ticked on their clock; one test runs its thread. Hard cases:
// HAP in resources/doc/hard-cases.md.
#include "simulation/practice/servo_loop.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/device/recorded_device.h"
#include "tests/simulation/practice/servo_bench.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

TEST(ServoLoop, PushesAHandOutOfTheWallOnceItIsArmed) {
  Servo servo;
  EXPECT_EQ(servo.Tick(500).scope.fault, Fault::kNotArmed);
  EXPECT_GT(glm::length(servo.loop.ReadSnapshot().scope.tip_force), 0.3)
      << "it is computed all the same";
  EXPECT_EQ(servo.scope.force(), glm::dvec3(0.0));
  servo.Arm();
  EXPECT_EQ(servo.scope.state(), DeviceState::kArmed);
  EXPECT_EQ(servo.loop.ReadSnapshot().scope.fault, Fault::kNone);
  // Spring of the wall, 500 N/m, against that of the hand, 300 N/m, less 0.26 N of friction of the
  // device.
  EXPECT_NEAR(servo.scope.force().z, -500 * 300 * kDepth / 800, 0.26 * 500 / 800 + 0.03);
  EXPECT_EQ(servo.instrument.force(), glm::dvec3(0.0)) << "it touches nothing";
  servo.HoldDeadMan(false);
  servo.Tick(2);
  EXPECT_EQ(servo.scope.force(), glm::dvec3(0.0));
}

TEST(ServoLoop, TheSecondButtonOfAHandleIsADeadMan) {
  Servo servo;
  servo.Tick(10);
  servo.scope.SetButtons(1);
  servo.Tick(100);
  EXPECT_EQ(servo.scope.state(), DeviceState::kReady) << "the first closes the jaws";
  servo.scope.SetButtons(2);
  servo.Tick(100);
  EXPECT_EQ(servo.scope.state(), DeviceState::kArmed);
  EXPECT_EQ(servo.instrument.state(), DeviceState::kReady);
}

TEST(ServoLoop, CallsItsObserverAfterEachTickWithTheTimeStep) {
  struct Watch final : ServoWatch {
    void AfterTick(const Snapshot& snapshot, double dt) noexcept override {
      ++ticks;
      time += dt;
      newest = snapshot.t;
    }
    int ticks = 0;
    double time = 0, newest = 0;
  } watch;
  ServoOptions options;
  options.watches = {&watch};
  Servo servo(options);
  servo.Tick(100);
  servo.Tick(1, 5 * kTick);
  EXPECT_EQ(watch.ticks, 101);
  EXPECT_NEAR(watch.time, 0.105, 1e-12);
  EXPECT_EQ(watch.newest, servo.loop.ReadSnapshot().t);
}

// Simulates a Hydra: a report every 4 ms, up to 4 ms late, and a servo with the same period.
class Tracker final : public Device {
 public:
  explicit Tracker(const glm::dvec3& at, Feedback feedback) {
    caps_.input = HandInput::kAbsolute;
    caps_.rate = 250;
    caps_.feedback = feedback;
    caps_.actuated_dof = feedback == Feedback::kForce ? 3 : 0;
    caps_.peak_force = 3;
    sample_.hip_in_device = at;
    sample_.valid = true;
    status_.state = DeviceState::kReady;
  }
  const DeviceCaps& caps() const noexcept override { return caps_; }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return name_; }
  DeviceSample Read(double now) noexcept override {
    while (next_ + late_ <= now) {
      sample_.t = next_ + late_;
      next_ += 0.004;
      late_ = 0.004 * static_cast<double>(++sent_ * 7919 % 101) / 101;
    }
    return sample_;
  }
  void HoldDeadMan(bool) noexcept override {}
  void Command(const glm::dvec3&) noexcept override {}
  DeviceStatus status() const noexcept override { return status_; }
  void Stop() noexcept { next_ = 1e9; }

 private:
  DeviceCaps caps_;
  std::string name_ = "tracker";
  DeviceSample sample_;
  DeviceStatus status_;
  double next_ = 0, late_ = 0;
  long sent_ = 0;
};

TEST(ServoLoop, SamplesOfA250HertzDeviceAreNotStale) {
  const auto stale = [](Feedback feedback, double period) {
    Session session(BareSphere());
    Tracker tracker(HipFromRodPose({0, 0, 0, 0.05}, session.scope_rig()), feedback);
    ServoLoop loop(session, &tracker, nullptr);
    int count = 0;
    double now = 1e-4;
    for (; now < 4.0; now += period) {
      loop.TickOnce(now);
      const Fault fault = loop.ReadSnapshot().scope.fault;
      count += fault == Fault::kStale || fault == Fault::kLost;
    }
    // Stops reporting: stale and lost are reported as usual.
    tracker.Stop();
    bool is_stale = false;
    for (const double end = now + 0.05; now < end; now += period) {
      loop.TickOnce(now);
      is_stale = is_stale || loop.ReadSnapshot().scope.fault == Fault::kStale;
    }
    EXPECT_TRUE(is_stale);
    EXPECT_EQ(loop.ReadSnapshot().scope.fault, Fault::kLost);
    return count;
  };
  EXPECT_EQ(stale(Feedback::kNone, 0.004), 0);
  EXPECT_EQ(stale(Feedback::kNone, 0.001), 0);
  EXPECT_GT(stale(Feedback::kForce, 0.001), 0) << "who is pushed is not spared";
}

TEST(ServoLoop, AppliesTheLowerOfDeviceLimitsAndRequestedLimits) {
  PlantOptions weak;
  weak.peak_force = 0.2;
  Servo servo({}, weak);
  EXPECT_EQ(servo.session.options().limiter.max_force, 0.2);
  EXPECT_EQ(servo.session.options().lever.max_stiffness, 500);
  EXPECT_EQ(servo.session.options().passivity.delay, 1);
  servo.request.options.limiter.max_force = 20;
  servo.request.options.lever.max_stiffness = 1e5;
  servo.request.options.contact.stiffness = 300;
  servo.request.incision_spacing = 0.02;
  servo.request.view_angle = 0.3;
  servo.request.instrument = ToolKind::kShaver;
  servo.loop.SetRequest(servo.request);
  servo.Tick();
  EXPECT_EQ(servo.session.options().limiter.max_force, 0.2);
  EXPECT_EQ(servo.session.options().lever.max_stiffness, 500);
  EXPECT_EQ(servo.session.options().contact.stiffness, 300);
  EXPECT_EQ(servo.session.incision_spacing(), 0.02);
  EXPECT_EQ(servo.session.view_angle(), 0.3);
  EXPECT_EQ(servo.session.instrument(), ToolKind::kShaver);
}

TEST(ServoLoop, CommandsForcesInTheFrameOfTheDevice) {
  LoadedScene loaded = BareSphere();
  // A quarter turn about x: y of the device is z of the portal.
  loaded.scene.rig.scope.portal_from_device = glm::dquat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  Session session(loaded);
  PlantDevice scope({}, kStiffHand, HipFromRodPose({0, 0, 0, 0.08 + kDepth}, session.scope_rig()));
  ServoLoop loop(session, &scope, nullptr);
  double now = 0;
  for (int i = 0; i < 10; ++i) loop.TickOnce(now += kTick);
  ServoRequest request{session.options(), 0, 0, {}, {}, ToolKind::kProbe, {true, true}};
  loop.SetRequest(request);
  for (int i = 0; i < 1000; ++i) loop.TickOnce(now += kTick);
  const glm::dvec3 in_portal = session.snapshot().scope.hand_force;
  ASSERT_LT(in_portal.z, -0.2);
  EXPECT_NEAR(scope.force().y, in_portal.z, 1e-9);
  EXPECT_NEAR(scope.force().z, -in_portal.y, 1e-9);
}

TEST(ServoLoop, RunsAt250HertzWithoutAForceDevice) {
  Session session(BareSphere());
  EXPECT_EQ(ServoLoop(session, nullptr, nullptr).period(), 0.004);
  EXPECT_EQ(session.options().lever.max_stiffness, SessionOptions{}.lever.max_stiffness);
  PlantDevice device({}, kHand, glm::dvec3(0, 0, -0.1));
  EXPECT_EQ(ServoLoop(session, nullptr, &device).period(), 0.001);
}

TEST(ServoLoop, EndsWithACommandOfNoForce) {
  Session session(BareSphere());
  PlantDevice scope({}, kHand, HipFromRodPose({0, 0, 0, 0.08 + kDepth}, session.scope_rig()));
  for (const bool is_thrown : {false, true}) {
    double now = is_thrown ? 10 : 0;
    try {
      ServoLoop loop(session, &scope, nullptr);
      ServoRequest request{session.options(), 0, 0, {}, {}, ToolKind::kProbe, {false, false}};
      loop.SetRequest(request);
      for (int i = 0; i < 10; ++i) loop.TickOnce(now += kTick);
      request.is_dead_man_held = {true, true};
      loop.SetRequest(request);
      for (int i = 0; i < 1000; ++i) loop.TickOnce(now += kTick);
      ASSERT_GT(glm::length(scope.force()), 0.1);
      if (is_thrown) throw std::runtime_error("of somebody else");
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(scope.force(), glm::dvec3(0.0));
  }
}

// Pushes in and out of the wall for four minutes, longer than the 190 s after which the warm-up is
// compensated (thermal.cpp). The test of one hour is OutputChain.HardCase24….
TEST(ServoLoop, HardCase24ALongSessionStaysBelowTheContinuousForceAndAllocatesNothing) {
  PlantOptions plant;
  plant.friction = 0;
  Servo servo({}, plant, kStiffHand);
  servo.request.options.lever.max_stiffness = 780;
  servo.Arm();
  const glm::dvec3 rest = servo.scope.plant().position();
  const long before = test::Allocations();
  double sum = 0;
  constexpr int kTicks = 240 * 1000;
  for (int i = 0; i < kTicks; ++i) {
    servo.scope.plant().SetIntent(rest + glm::dvec3(0, 0, 7e-3 + 2e-3 * std::sin(2 * i * kTick)));
    servo.Tick(1, i % 1000 == 500 ? 3 * kTick : kTick);
    sum += glm::length(servo.scope.force());
  }
  EXPECT_EQ(test::Allocations(), before);
  const double mean = sum / kTicks, bears = servo.scope.caps().continuous_force;
  std::printf("four minutes: mean %.3f N of %.2f N\n", mean, bears);
  EXPECT_GT(mean, 0.5 * bears) << "else nothing was asked";
  EXPECT_LE(mean, bears);
  servo.Tick(100);
  EXPECT_EQ(servo.loop.ReadReport().missed, 2L * kTicks / 1000) << "gaps are counted";
  EXPECT_GE(servo.loop.ReadReport().ticks, kTicks);
}

TEST(ServoLoop, DrivesRecordedHandsOnTheClockAndTheTimeStepOfItsCaller) {
  Session session(BareSphere());
  std::vector<TraceRow> rows(2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RodPose pose{0, 0, 0, 0.03 + 0.0005 * static_cast<double>(i)};
    rows[i].sample = {static_cast<double>(i), HipFromRodPose(pose, session.scope_rig()),
                      HandleFromRodPose(pose, session.scope_rig()), 0, true};
  }
  RecordedDevice scope(rows, DeviceRole::kScope), instrument(rows, DeviceRole::kInstrument);
  ServoOptions options;
  options.period_without_force = kServoPeriod;
  ServoLoop loop(session, &scope, &instrument, options);
  loop.TickOnce(0.0, kTick);
  EXPECT_NEAR(loop.ReadSnapshot().scope.pose.depth, 0.03, 1e-12);
  loop.TickOnce(0.5, kTick);
  EXPECT_EQ(loop.ReadSnapshot().t, kTick + kTick) << "not the difference of the two times";
  EXPECT_NEAR(loop.ReadSnapshot().scope.pose.depth, 0.03025, 1e-12);
  EXPECT_EQ(loop.ReadSnapshot().scope.fault, Fault::kNone);
  EXPECT_EQ(loop.ReadSnapshot().instrument.fault, Fault::kNoSample) << "it has no row";
  loop.Stop();
  EXPECT_EQ(loop.ReadReport().compute.count(), 2);
}

TEST(ServoLoop, ThreadTicksReportsAndStops) {
  Servo servo;
  servo.loop.Start();
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::minutes(5);
  while (servo.loop.ReadReport().ticks < 300 && Clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GT(servo.loop.ReadSnapshot().t, 0.2) << "of the true time";
  servo.loop.Stop();
  const ServoReport report = servo.loop.ReadReport();
  EXPECT_GE(report.ticks, 300);
  EXPECT_EQ(report.lateness.count(), report.ticks);
  EXPECT_EQ(report.compute.count(), report.ticks);
  EXPECT_GT(report.sample_age[0].count(), 0);
  EXPECT_EQ(DescribeTrouble(report).empty(), report.has_priority);
  EXPECT_EQ(report.true_period > report.period, !report.has_priority);
  // Late ticks lower the stiffness.
  EXPECT_NEAR(servo.session.options().lever.max_stiffness, 500 * report.period / report.true_period,
              1e-9);
  std::printf(
      "priority %s; lateness p50 %.0f p99 %.0f p99.9 %.0f us, compute p50 %.1f p99 %.1f us\n",
      report.has_priority ? "yes" : "no", 1e6 * report.lateness.Quantile(0.5),
      1e6 * report.lateness.Quantile(0.99), 1e6 * report.lateness.Quantile(0.999),
      1e6 * report.compute.Quantile(0.5), 1e6 * report.compute.Quantile(0.99));
  const long ticks = report.ticks;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(servo.loop.ReadReport().ticks, ticks);
  servo.loop.Start();  // starts again
  servo.loop.Stop();
}

static_assert(noexcept(std::declval<ServoLoop&>().TickOnce(0.0)));

}  // namespace
}  // namespace arthro::simulation
