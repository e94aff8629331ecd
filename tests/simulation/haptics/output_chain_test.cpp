// The whole output chain: its stages and their order. Hard cases: HAP in
// resources/doc/hard-cases.md.
#include "simulation/haptics/output/output_chain.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/device/hand_plant.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct Chain {
  PassivityOptions passivity;
  ThermalOptions thermal;
  LimiterOptions limiter;
  LeverOptions lever;
  OutputState state;
  LimitedForce Send(const TipForce& tip, int ticks = 1) {
    LimitedForce sent;
    for (int i = 0; i < ticks; ++i)
      sent = ForceToHand({passivity, thermal, limiter}, tip, kTick, state);
    return sent;
  }
};

// Rod of 0.2 m with the hand 0.1 m from the incision: across it a force is only reversed.
TipForce Push(const glm::dvec3& force, double r = 0.1) {
  TipForce tip;
  tip.force = force;
  tip.stiffness = 500;
  tip.hand = {0, 0, r};
  tip.lever = LeverAt(tip.hand, 0.2, {});
  return tip;
}

TEST(OutputChain, HardCase6AnyForceIsFiniteClampedAndKeepsItsDirection) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(3, -4, 12));
  for (const double size : {1e6, 1e30, 1e150, 1e300}) {
    Chain chain;
    const LimitedForce sent = chain.Send(Push(size * direction), 1000);
    EXPECT_NEAR(glm::length(sent.force), chain.limiter.max_force, 1e-9) << size;
    EXPECT_NEAR(
        glm::dot(glm::normalize(sent.force), glm::normalize(HandForce(Push({}).lever, direction))),
        1.0, 1e-12);
    EXPECT_EQ(sent.fault, Fault::kNone);
  }
  for (const double bad : {kNoNumber, HUGE_VAL, -HUGE_VAL}) {
    Chain chain;
    chain.Send(Push({1, 0, 0}), 1000);
    const LimitedForce sent = chain.Send(Push({0, bad, 0}));
    EXPECT_EQ(sent.force, glm::dvec3(0.0));
    EXPECT_EQ(sent.fault, Fault::kNotFinite);
    const LimitedForce next = chain.Send(Push({1, 0, 0}));
    EXPECT_EQ(next.fault, Fault::kNone);
    EXPECT_LT(glm::length(next.force), 0.01) << "ramps again";
  }
  Chain chain;
  const double denormal = std::numeric_limits<double>::denorm_min();
  EXPECT_LE(glm::length(chain.Send(Push({denormal, 0, 0}), 1000).force), 1e-300);
}

TEST(OutputChain, HardCase7ArmedInsideTissueTheForceRampsOverHalfASecond) {
  Chain chain;
  TipForce tip = Push({0, 0, 2});
  tip.push = HandPush::kNo;
  for (int i = 0; i < 3000; ++i) {
    const LimitedForce sent = chain.Send(tip);
    ASSERT_EQ(sent.force, glm::dvec3(0.0));
    ASSERT_EQ(sent.fault, Fault::kNotArmed);
  }
  tip.push = HandPush::kYes;
  double last = 0;
  for (int i = 1; i <= 700; ++i) {
    const double now = glm::length(chain.Send(tip).force);
    ASSERT_LE(now, 2.0 * std::min(1.0, i * kTick / 0.5) + 1e-12);
    ASSERT_GE(now, last);
    last = now;
  }
  EXPECT_NEAR(last, 2.0, 1e-12) << "and no more than the static force";
}

TEST(OutputChain, APauseIsZeroForOneTickAndDoesNotRampAgain) {
  Chain chain;
  TipForce tip = Push({0, 0, 2});
  chain.Send(tip, 1000);
  tip.push = HandPush::kPause;
  const LimitedForce paused = chain.Send(tip);
  EXPECT_EQ(paused.force, glm::dvec3(0.0));
  EXPECT_EQ(paused.fault, Fault::kNone);
  tip.push = HandPush::kYes;
  for (int i = 1; i <= 10; ++i)
    EXPECT_NEAR(glm::length(chain.Send(tip).force),
                std::min(2.0, chain.limiter.max_rise * kTick * i), 1e-12);
}

TEST(OutputChain, HardCase15NearTheIncisionTheForceFadesAndNeverFlutters) {
  Chain chain;
  const TipForce far = Push({1, 0.3, 0.2}, 0.0151);
  chain.Send(far, 1000);
  glm::dvec3 last = chain.Send(far).force;
  // Moves straight through the incision to the other side at 20 mm/s, in steps of 0.02 mm.
  double strongest_inside = 0, largest_rise = 0;
  int turns = 0;
  for (double z = 0.0151; z > -0.0151; z -= 2e-5) {
    TipForce tip = far;
    tip.hand = {0, 0, z};
    tip.hand_speed = 0.02;
    tip.lever = LeverAt(tip.hand, 0.2, {});
    const LimitedForce sent = chain.Send(tip);
    ASSERT_TRUE(std::isfinite(sent.force.x + sent.force.y + sent.force.z)) << z;
    ASSERT_LE(glm::length(sent.force), chain.limiter.max_force + 1e-12);
    if (std::abs(z) < 0.005) strongest_inside = std::max(strongest_inside, glm::length(sent.force));
    largest_rise = std::max(largest_rise, glm::length(sent.force) - glm::length(last));
    turns += glm::dot(sent.force, last) < 0;
    last = sent.force;
  }
  EXPECT_EQ(strongest_inside, 0.0);
  EXPECT_LE(turns, 1);
  EXPECT_LE(largest_rise, chain.limiter.max_rise * kTick + 1e-12);
  for (const double r : {0.0, 1e-300, 1e-6, 1e-3}) {
    Chain at;
    EXPECT_EQ(at.Send(Push({1, 1, 1}, r), 10).force, glm::dvec3(0.0)) << r;
  }
  // Tip at the incision: no force across the rod, all of it along.
  Chain at;
  const LimitedForce sent = at.Send(Push({1, 1, 1}, 0.2), 1000);
  EXPECT_LT(glm::length(sent.force - glm::dvec3(0, 0, 1)), 1e-12);
}

// Requests 3 N for one hour.
TEST(OutputChain, HardCase24TheMeanOverAnHourIsBelowTheContinuousForce) {
  Chain chain;
  chain.thermal.continuous_force = 0.88;
  const TipForce tip = Push({0, 0, 3});
  const long before = test::Allocations();
  double sum = 0;
  constexpr int kTicks = 3600 * 1000;
  for (int i = 0; i < kTicks; ++i) sum += glm::length(chain.Send(tip).force);
  std::printf("mean over an hour: %.4f N of 0.88 N\n", sum / kTicks);
  EXPECT_LE(sum / kTicks, 0.88);
  EXPECT_GT(sum / kTicks, 0.9 * 0.88) << "what it bears may be used";
  EXPECT_EQ(test::Allocations(), before);
}

TEST(OutputChain, TheGuardPrecedesTheClampAndUsesTheSentForce) {
  // Wall of 4000 N/m with a delay of one tick, against a hand of 300 N/m.
  double swing[2];
  for (const bool is_guarded : {false, true}) {
    Chain chain;
    chain.limiter.ramp_time = 0;
    chain.limiter.max_rise = 1e4;
    if (!is_guarded) chain.passivity.max_damping = 0;
    HandPlant plant({0.045, 0.2, 0, 5.5e-5, 3.3, 1}, kHand, {1e-3, 0, 0.1});
    plant.SetIntent({-5e-3, 0, 0.1});
    double low = 1, high = -1;
    for (int i = 0; i < 2000; ++i) {
      TipForce tip;
      tip.hand = plant.Sample().hip_in_device;
      tip.lever.across = 1;
      tip.lever.fade = 1;
      tip.stiffness = 4000;
      tip.force = {4000 * std::max(0.0, -tip.hand.x), 0, 0};
      const glm::dvec3 sent = chain.Send(tip).force;
      ASSERT_EQ(chain.state.guard.sent[(chain.state.guard.count - 1) % 8], sent);
      ASSERT_LE(glm::length(sent), chain.limiter.max_force + 1e-12);
      plant.Tick(sent, kTick);
      if (i < 1500) continue;
      low = std::min(low, plant.position().x);
      high = std::max(high, plant.position().x);
    }
    swing[is_guarded] = high - low;
  }
  std::printf("4000 N/m: swing %.2f -> %.2f mm\n", 1e3 * swing[0], 1e3 * swing[1]);
  EXPECT_LT(swing[1], 0.5 * swing[0]);
}

}  // namespace
}  // namespace arthro::simulation
