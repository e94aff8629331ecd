// Sentence about a hand without force (simulation/practice/hands/why_no_force.h).
#include "simulation/practice/hands/why_no_force.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

// Situation of a force device that pushes.
ForceSituation Pushing() {
  ForceSituation s;
  s.kind = HandKind::kPluggedIn;
  s.caps.feedback = Feedback::kForce;
  s.caps.actuated_dof = 3;
  s.caps.peak_force = 3.3;
  s.status = {DeviceState::kArmed, DeviceTrouble::kNone, false};
  s.sample_age = 0.001;
  s.is_dead_man_held = s.is_practising = s.has_force = true;
  return s;
}

bool Says(const ForceSituation& situation, const char* part) {
  const std::string sentence = WhyNoForce(situation);
  return sentence.find(part) != std::string::npos;
}

TEST(WhyNoForce, IsEmptyWhereThereIsForce) { EXPECT_STREQ(WhyNoForce(Pushing()), ""); }

TEST(WhyNoForce, NamesEachSingleObstacle) {
  const auto with = [](auto change) {
    ForceSituation s = Pushing();
    change(s);
    return s;
  };
  EXPECT_TRUE(Says(with([](auto& s) { s.kind = HandKind::kMouse; }), "No device"));
  EXPECT_TRUE(Says(with([](auto& s) { s.kind = HandKind::kRecorded; }), "recording"));
  EXPECT_TRUE(Says(with([](auto& s) { s.is_calibrating = true; }), "calibrated"));
  EXPECT_TRUE(Says(with([](auto& s) { s.status.state = DeviceState::kAbsent; }), "plug it in"));
  EXPECT_TRUE(Says(with([](auto& s) { s.status.state = DeviceState::kOpening; }), "opened"));
  EXPECT_TRUE(Says(with([](auto& s) { s.status.state = DeviceState::kHoming; }), "rest"));
  EXPECT_TRUE(Says(with([](auto& s) {
                     s.status = {DeviceState::kLost, DeviceTrouble::kReadError, true};
                   }),
                   "unplugged"));
  EXPECT_TRUE(Says(with([](auto& s) {
                     s.status = {DeviceState::kFault, DeviceTrouble::kNotFinite, true};
                   }),
                   "no number"));
  EXPECT_TRUE(Says(with([](auto& s) { s.caps.feedback = Feedback::kNone; }), "motors"));
  EXPECT_TRUE(Says(with([](auto& s) { s.caps.feedback = Feedback::kRumble; }), "rumbles"));
  EXPECT_TRUE(Says(with([](auto& s) { s.is_zero_force = true; }), "Zero-force"));
  EXPECT_TRUE(Says(with([](auto& s) { s.is_practising = false; }), "only in a practice"));
  EXPECT_TRUE(Says(with([](auto& s) { s.sample_age = 0.006; }), "older than 5 ms"));
  EXPECT_TRUE(Says(with([](auto& s) { s.sample_age = 0.021; }), "more than 20 ms"));
  EXPECT_TRUE(Says(with([](auto& s) { s.sample_age = std::numeric_limits<double>::quiet_NaN(); }),
                   "20 ms"));
  EXPECT_TRUE(Says(with([](auto& s) { s.is_dead_man_held = false; }), "dead-man"));
  EXPECT_TRUE(Says(with([](auto& s) {
                     s.status = {DeviceState::kReady, DeviceTrouble::kNone, true};
                   }),
                   "let go of it"));
  EXPECT_TRUE(Says(with([](auto& s) { s.fault = Fault::kTooFast; }), "slow down"));
  EXPECT_TRUE(Says(with([](auto& s) { s.has_force = false; }), "Nothing is touched"));
}

TEST(WhyNoForce, NamesTheFirstObstacleToRemove) {
  ForceSituation s = Pushing();
  s.has_force = s.is_dead_man_held = false;
  s.is_zero_force = true;
  s.sample_age = 1;
  s.status = {DeviceState::kLost, DeviceTrouble::kSilent, true};
  EXPECT_TRUE(Says(s, "says nothing"));
  s.status = {DeviceState::kReady, DeviceTrouble::kNone, true};
  EXPECT_TRUE(Says(s, "Zero-force"));
  s.is_zero_force = false;
  EXPECT_TRUE(Says(s, "20 ms"));
  s.sample_age = 0;
  EXPECT_TRUE(Says(s, "Nobody holds"));
  s.is_dead_man_held = true;
  EXPECT_TRUE(Says(s, "let go of it"));
}

}  // namespace
}  // namespace arthro::simulation
