// The steps of the first hour judge a sound device as passed and each planted fault as failed.
#include "simulation/practice/first_hour/first_hour.h"

#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/tried_hand.h"

namespace arthro::simulation {
namespace {

using test::TriedHand;

// A device between the program and a sound one, whose forces are wrong.
class MiswiredDevice final : public Device {
 public:
  MiswiredDevice(PlantDevice& sound, std::function<glm::dvec3(const glm::dvec3&)> wiring)
      : sound_(sound), wiring_(std::move(wiring)) {}
  const DeviceCaps& caps() const noexcept override { return sound_.caps(); }
  const std::string& name() const noexcept override { return sound_.name(); }
  const std::string& serial() const noexcept override { return sound_.serial(); }
  DeviceSample Read(double now) noexcept override { return sound_.Read(now); }
  void HoldDeadMan(bool is_held) noexcept override { sound_.HoldDeadMan(is_held); }
  void Command(const glm::dvec3& force) noexcept override { sound_.Command(wiring_(force)); }
  DeviceStatus status() const noexcept override { return sound_.status(); }

 private:
  PlantDevice& sound_;
  std::function<glm::dvec3(const glm::dvec3&)> wiring_;
};

constexpr std::array kRightHanded{Way::kRight, Way::kLeft, Way::kUp,
                                  Way::kDown,  Way::kToMe, Way::kAway};

std::vector<Push> Pushes(Device& device, TriedHand& hand, std::span<const Way> ways) {
  std::vector<Push> pushes;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      ForceTrial trial;
      trial.force[axis] = sign * TrialForce(device.caps());
      trial.limiter.max_force = TrialForce(device.caps());
      pushes.push_back({trial.force, TryForce(device, trial, hand.Ticks()), ways[pushes.size()]});
    }
  return pushes;
}

TEST(FirstHour, TheForceOfTheTrialsIsSmall) {
  DeviceCaps caps;
  caps.peak_force = 3;
  EXPECT_DOUBLE_EQ(TrialForce(caps), 1);
  caps.peak_force = 0.9;
  EXPECT_DOUBLE_EQ(TrialForce(caps), 0.3);
  caps.peak_force = 20;
  EXPECT_DOUBLE_EQ(TrialForce(caps), 1);
}

TEST(FirstHour, ASoundDevicePushesAlongItsForce) {
  TriedHand hand;
  const HourVerdict verdict = JudgeDirection(Pushes(hand.device, hand, kRightHanded));
  EXPECT_TRUE(verdict.has_passed) << verdict.sentence;
}

TEST(FirstHour, MiswiredMotorsAreNamed) {
  struct Case {
    std::function<glm::dvec3(const glm::dvec3&)> wiring;
    const char* words;
  };
  const std::vector<Case> cases{
      {[](const glm::dvec3& f) { return glm::dvec3(-f.x, f.y, f.z); }, "reversed"},
      {[](const glm::dvec3& f) { return glm::dvec3(f.y, f.x, f.z); }, "exchanged"},
      {[](const glm::dvec3& f) { return glm::dvec3(f.x, f.y, 0); }, "only"}};
  for (const Case& each : cases) {
    TriedHand hand;
    MiswiredDevice device(hand.device, each.wiring);
    const HourVerdict verdict = JudgeDirection(Pushes(device, hand, kRightHanded));
    EXPECT_FALSE(verdict.has_passed);
    EXPECT_NE(verdict.sentence.find(each.words), std::string::npos) << verdict.sentence;
  }
}

TEST(FirstHour, AMirroredFrameIsFeltThoughEncodersAgreeWithMotors) {
  TriedHand hand;
  std::vector<Push> pushes = Pushes(hand.device, hand, kRightHanded);
  pushes[0].way = Way::kLeft;
  EXPECT_NE(JudgeDirection(pushes).sentence.find("opposite"), std::string::npos);
  pushes[1].way = Way::kRight;
  EXPECT_NE(JudgeDirection(pushes).sentence.find("left-handed"), std::string::npos);
  pushes[0].way = Way::kUp;
  pushes[1].way = Way::kDown;
  EXPECT_NE(JudgeDirection(pushes).sentence.find("same line"), std::string::npos);
  pushes[1].way.reset();
  EXPECT_FALSE(JudgeDirection(pushes).has_passed);
  // Turned, as on a device whose z points up, and still right-handed.
  const std::array turned{Way::kToMe, Way::kAway, Way::kRight, Way::kLeft, Way::kUp, Way::kDown};
  for (std::size_t i = 0; i < pushes.size(); ++i) pushes[i].way = turned[i];
  EXPECT_TRUE(JudgeDirection(pushes).has_passed) << JudgeDirection(pushes).sentence;
}

TEST(FirstHour, ScaleIsReadOnABalance) {
  EXPECT_TRUE(JudgeScale(std::array{BalanceReading{0.5, 0.45}, BalanceReading{1, 1.2}}).has_passed);
  for (const double read : {0.7, 1.3, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(JudgeScale(std::array{BalanceReading{1, read}}).has_passed) << read;
  EXPECT_FALSE(JudgeScale(std::array{BalanceReading{1, std::nullopt}}).has_passed);
  EXPECT_FALSE(JudgeScale({}).has_passed);
}

TEST(FirstHour, ZeroForceFailsWhereItIsFeltOrSamplesAreRare) {
  TriedHand hand;
  ForceTrial trial;
  const TrialReport report = TryForce(hand.device, trial, hand.Ticks());
  EXPECT_TRUE(JudgeZero(report, hand.device.caps(), false).has_passed)
      << JudgeZero(report, hand.device.caps(), false).sentence;
  EXPECT_FALSE(JudgeZero(report, hand.device.caps(), true).has_passed);
  DeviceCaps faster = hand.device.caps();
  faster.rate = 2000;
  EXPECT_FALSE(JudgeZero(report, faster, false).has_passed);
}

TEST(FirstHour, LimitLossAndStopFollowTheTrial) {
  TriedHand hand;
  ForceTrial trial;
  trial.force = {10, 0, 0};
  trial.limiter.max_force = 1;
  const TrialReport whole = TryForce(hand.device, trial, hand.Ticks());
  EXPECT_TRUE(JudgeLimit(whole, trial).has_passed) << JudgeLimit(whole, trial).sentence;
  ForceTrial lower = trial;
  lower.limiter.max_force = 0.5;
  EXPECT_FALSE(JudgeLimit(whole, lower).has_passed);
  EXPECT_FALSE(JudgeLoss(whole).has_passed) << "nobody pulled the cable";
  EXPECT_FALSE(JudgeStop(whole, true).has_passed) << "nobody stopped it";

  const double begin = hand.now;
  hand.event = [&](double now) { hand.device.SetPlugged(now < begin + 1); };
  const TrialReport pulled = TryForce(hand.device, trial, hand.Ticks());
  EXPECT_TRUE(JudgeLoss(pulled).has_passed) << JudgeLoss(pulled).sentence;
  EXPECT_FALSE(JudgeLimit(pulled, trial).has_passed);
  TrialReport late = pulled;
  late.silence = 0.0071;
  EXPECT_FALSE(JudgeLoss(late).has_passed);
  TrialReport unpushed = pulled;
  unpushed.largest = 0;
  EXPECT_FALSE(JudgeLoss(unpushed).has_passed);

  hand.event = [](double) {};
  hand.device.SetPlugged(true);
  const double again = hand.now;
  hand.event = [&](double now) { hand.is_held = now < again + 1; };
  const TrialReport released = TryForce(hand.device, trial, hand.Ticks());
  EXPECT_TRUE(JudgeStop(released, true).has_passed) << JudgeStop(released, true).sentence;
  EXPECT_FALSE(JudgeStop(released, false).has_passed);
  EXPECT_FALSE(JudgeLoss(released).has_passed);
}

}  // namespace
}  // namespace arthro::simulation
