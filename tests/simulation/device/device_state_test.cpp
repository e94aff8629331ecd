#include "simulation/device/device_state.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

using enum DeviceState;
using enum DeviceTrouble;

constexpr std::array kStates{kAbsent, kOpening, kHoming, kReady, kArmed, kFault, kLost};
constexpr std::array kTroubles{kNone,      kNoPermission, kHeldElsewhere, kUnsupported, kNotFinite,
                               kSlowWrite, kReadError,    kWriteError,    kSilent};
const std::array kAges{0.0,
                       0.001,
                       kFreshFor - 2 * kClockGrain,
                       std::nextafter(kFreshFor, 0.0),
                       kFreshFor,
                       std::nextafter(kFreshFor, 1.0),
                       0.010,
                       kLostAfter,
                       std::nextafter(kLostAfter, 1.0),
                       0.3,
                       -0.001,
                       std::numeric_limits<double>::infinity(),
                       std::nan("")};

DeviceEvents Good() {
  DeviceEvents events;
  events.is_present = events.is_open = events.is_homed = events.has_sample = true;
  return events;
}

// Every status with every combination of events.
template <class Check>
long ForAll(Check check) {
  long count = 0;
  for (const DeviceState state : kStates)
    for (const DeviceTrouble reason : kTroubles)
      for (const bool must_release : {false, true})
        for (const DeviceTrouble trouble : kTroubles)
          for (const double age : kAges)
            for (int bits = 0; bits < 32; ++bits) {
              DeviceEvents events;
              events.is_present = bits & 1;
              events.is_open = bits & 2;
              events.is_homed = bits & 4;
              events.has_sample = bits & 8;
              events.is_dead_man_held = bits & 16;
              events.sample_age = age;
              events.trouble = trouble;
              check(DeviceStatus{state, reason, must_release}, events);
              ++count;
              if (testing::Test::HasFailure()) return count;
            }
  return count;
}

bool IsWhole(const DeviceEvents& e) {
  return e.is_present && e.is_open && e.is_homed && e.has_sample && e.trouble == kNone;
}

TEST(DeviceState, ArmsOnlyWithoutTroubleWithAFreshSampleAndAPressedDeadMan) {
  int armed = 0;
  ForAll([&](const DeviceStatus& status, const DeviceEvents& events) {
    if (Next(status, events).state != kArmed) return;
    ++armed;
    ASSERT_TRUE(status.state == kReady || status.state == kArmed);
    ASSERT_TRUE(IsWhole(events) && events.is_dead_man_held && !status.must_release);
    if (status.state == kReady)
      ASSERT_LT(events.sample_age, kFreshFor);
    else
      ASSERT_LE(events.sample_age, kLostAfter);
  });
  EXPECT_GT(armed, 0);
}

TEST(DeviceState, PushesOnlyWithASampleYoungerThan5Milliseconds) {
  int pushes = 0;
  ForAll([&](const DeviceStatus& status, const DeviceEvents& events) {
    if (!MayPush(status, events)) return;
    ++pushes;
    ASSERT_EQ(status.state, kArmed);
    ASSERT_TRUE(IsWhole(events) && events.is_dead_man_held);
    ASSERT_TRUE(events.sample_age >= 0 && events.sample_age < 0.005);
  });
  EXPECT_GT(pushes, 0);
}

TEST(DeviceState, EveryTroubleEndsAReadyState) {
  const std::set<DeviceTrouble> faults{kNoPermission, kHeldElsewhere, kUnsupported, kNotFinite,
                                       kSlowWrite};
  ForAll([&](const DeviceStatus& status, const DeviceEvents& events) {
    const bool runs = status.state == kHoming || status.state == kReady || status.state == kArmed;
    if (!runs || events.trouble == kNone) return;
    const DeviceStatus next = Next(status, events);
    ASSERT_EQ(next.state, faults.contains(events.trouble) ? kFault : kLost);
    ASSERT_EQ(next.reason, events.trouble);
    ASSERT_TRUE(next.must_release);
  });
}

TEST(DeviceState, ASampleOlderThan20MillisecondsIsALoss) {
  for (const DeviceState state : {kReady, kArmed})
    for (const double age : kAges) {
      DeviceEvents events = Good();
      events.is_dead_man_held = true;
      events.sample_age = age;
      const DeviceStatus next = Next({state, kNone, false}, events);
      EXPECT_EQ(next.state == kLost, !(age <= 0.020)) << age;
      if (next.state == kLost) {
        EXPECT_EQ(next.reason, kSilent);
      }
    }
}

TEST(DeviceState, ChangesOnlyAlongAllowedTransitions) {
  const std::set<std::pair<DeviceState, DeviceState>> ways{
      {kAbsent, kOpening}, {kOpening, kAbsent}, {kOpening, kHoming}, {kOpening, kFault},
      {kHoming, kReady},   {kHoming, kFault},   {kHoming, kLost},    {kReady, kArmed},
      {kReady, kHoming},   {kReady, kFault},    {kReady, kLost},     {kArmed, kReady},
      {kArmed, kHoming},   {kArmed, kFault},    {kArmed, kLost},     {kFault, kAbsent},
      {kFault, kOpening},  {kFault, kHoming},   {kFault, kLost},     {kLost, kAbsent},
      {kLost, kOpening},   {kLost, kHoming}};
  std::set<std::pair<DeviceState, DeviceState>> seen;
  ForAll([&](const DeviceStatus& status, const DeviceEvents& events) {
    const DeviceState next = Next(status, events).state;
    if (next == status.state) return;
    ASSERT_TRUE(ways.contains({status.state, next}))
        << ToString(status.state) << " to " << ToString(next);
    seen.insert({status.state, next});
  });
  EXPECT_EQ(seen, ways) << "each of them can happen";
}

TEST(DeviceState, AnIntactDeviceIsReadyWithinFourStepsFromAnyState) {
  for (const DeviceState state : kStates)
    for (const DeviceTrouble reason : kTroubles) {
      DeviceStatus status{state, reason, true};
      for (int i = 0; i < 4; ++i) status = Next(status, Good());
      EXPECT_EQ(status, (DeviceStatus{kReady, kNone, false})) << ToString(state);
      DeviceEvents held = Good();
      held.is_dead_man_held = true;
      EXPECT_EQ(Next(status, held).state, kArmed);
    }
}

TEST(DeviceState, APermanentlyHeldDeadManNeverArms) {
  DeviceEvents held = Good();
  held.is_dead_man_held = true;
  for (const DeviceState start : {kAbsent, kOpening, kHoming, kFault, kLost}) {
    DeviceStatus status{start, kNone, true};
    for (int i = 0; i < 100; ++i) {
      status = Next(status, held);
      ASSERT_NE(status.state, kArmed) << ToString(start);
    }
    EXPECT_EQ(status.state, start == kFault ? kFault : kReady);
  }
}

TEST(DeviceState, AFaultLastsUntilTheDeadManIsReleased) {
  DeviceEvents events = Good();
  events.is_dead_man_held = true;
  events.trouble = kNotFinite;
  DeviceStatus status = Next({kArmed, kNone, false}, events);
  events.trouble = kSlowWrite;
  for (int i = 0; i < 5; ++i) status = Next(status, events);
  EXPECT_EQ(status.reason, kNotFinite) << "the first";
  events.trouble = kNone;
  for (int i = 0; i < 5; ++i) status = Next(status, events);
  EXPECT_EQ(status.state, kFault);
  events.is_dead_man_held = false;
  for (const DeviceState next : {kHoming, kReady})
    EXPECT_EQ((status = Next(status, events)).state, next);
}

TEST(DeviceState, DescribesEveryStateAndReason) {
  std::set<std::string> words, sentences;
  for (const DeviceState state : kStates) words.insert(ToString(state));
  EXPECT_EQ(words.size(), kStates.size());
  for (const DeviceTrouble reason : kTroubles) {
    const std::string sentence = DescribeStatus({kFault, reason, true});
    EXPECT_GT(sentence.size(), 20u);
    sentences.insert(sentence);
  }
  EXPECT_EQ(sentences.size(), kTroubles.size() - 1) << "a read and a write fail alike";
  EXPECT_NE(std::string(DescribeStatus({kFault, kNoPermission, true})).find("70-arthroscene.rules"),
            std::string::npos);
}

}  // namespace
}  // namespace arthro::simulation
