#include "simulation/haptics/output/force_limiter.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LimitedForce Settle(const LimiterOptions& options, const glm::dvec3& force, LimiterState& state,
                    int ticks = 1000) {
  LimitedForce limited;
  for (int i = 0; i < ticks; ++i)
    limited = LimitForce(options, force, 0, Fault::kNone, kTick, state);
  return limited;
}

// HAP-06.
TEST(ForceLimiter, HugeForceKeepsItsDirection) {
  const LimiterOptions options;
  const glm::dvec3 direction = glm::normalize(glm::dvec3(3, -4, 12));
  for (double size : {1e6, 1e30, 1e200, 1e307}) {
    LimiterState state;
    const LimitedForce limited = Settle(options, size * direction, state);
    EXPECT_NEAR(glm::length(limited.force), options.max_force, 1e-12) << size;
    EXPECT_NEAR(glm::dot(glm::normalize(limited.force), direction), 1.0, 1e-12) << size;
    EXPECT_EQ(limited.fault, Fault::kNone);
  }
}

TEST(ForceLimiter, SmallForcesPassUnchanged) {
  LimiterState state;
  const glm::dvec3 force(0.3, -0.2, 0.1);
  EXPECT_LT(glm::length(Settle({}, force, state).force - force), 1e-15);
  const double denormal = std::numeric_limits<double>::denorm_min();
  state = {};
  const LimitedForce tiny = Settle({}, glm::dvec3(denormal, 0, 0), state);
  EXPECT_TRUE(std::isfinite(tiny.force.x));
  EXPECT_LE(glm::length(tiny.force), 1e-300);
  EXPECT_EQ(tiny.fault, Fault::kNone);
}

TEST(ForceLimiter, NotANumberGivesZeroAndAFault) {
  for (const glm::dvec3 force : {glm::dvec3(kNan, 0, 0), {0, kInfinity, 0}, {0, 0, -kInfinity}}) {
    LimiterState state;
    Settle({}, {1, 0, 0}, state);
    const LimitedForce limited = LimitForce({}, force, 0, Fault::kNone, kTick, state);
    EXPECT_EQ(limited.force, glm::dvec3(0.0));
    EXPECT_EQ(limited.fault, Fault::kNotFinite);
    // A NaN tick must not affect the next one.
    const LimitedForce next = LimitForce({}, {1, 0, 0}, 0, Fault::kNone, kTick, state);
    EXPECT_TRUE(std::isfinite(next.force.x));
    EXPECT_EQ(next.fault, Fault::kNone);
  }
  LimiterState state;
  EXPECT_EQ(LimitForce({}, {1, 0, 0}, kNan, Fault::kNone, kTick, state).fault, Fault::kNotFinite);
}

TEST(ForceLimiter, AnEarlierFaultGivesZero) {
  for (Fault fault : {Fault::kNoSample, Fault::kStale, Fault::kLost, Fault::kNotFinite}) {
    LimiterState state;
    Settle({}, {1, 0, 0}, state);
    const LimitedForce limited = LimitForce({}, {1, 0, 0}, 0, fault, kTick, state);
    EXPECT_EQ(limited.force, glm::dvec3(0.0));
    EXPECT_EQ(limited.fault, fault);
  }
}

TEST(ForceLimiter, RisesAtItsRateAndFallsAtOnce) {
  LimiterOptions options;
  options.ramp_time = 0.0;
  LimiterState state;
  double last = 0;
  for (int i = 1; i <= 20; ++i) {
    const double now =
        glm::length(LimitForce(options, {3, 0, 0}, 0, Fault::kNone, kTick, state).force);
    EXPECT_NEAR(now, std::min(3.0, 0.3 * i), 1e-12);
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_EQ(LimitForce(options, {0, 0, 0}, 0, Fault::kNone, kTick, state).force, glm::dvec3(0.0));
}

TEST(ForceLimiter, AReversedForceStartsFromZero) {
  LimiterOptions options;
  LimiterState state;
  Settle(options, {3, 0, 0}, state);
  const LimitedForce turned = LimitForce(options, {-3, 0, 0}, 0, Fault::kNone, kTick, state);
  EXPECT_NEAR(turned.force.x, -0.3, 1e-12);
}

// HAP-07: armed inside tissue.
TEST(ForceLimiter, ForceRampsAfterArming) {
  const LimiterOptions options;
  LimiterState state;
  double last = 0;
  for (int i = 1; i <= 600; ++i) {
    const double now =
        glm::length(LimitForce(options, {2, 0, 0}, 0, Fault::kNone, kTick, state).force);
    EXPECT_LE(now, 2.0 * std::min(1.0, i * kTick / options.ramp_time) + 1e-12);
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_NEAR(last, 2.0, 1e-12);
}

TEST(ForceLimiter, FastHandGetsNoForceAndARampAfter) {
  const LimiterOptions options;
  LimiterState state;
  Settle(options, {2, 0, 0}, state);
  const LimitedForce fast = LimitForce(options, {2, 0, 0}, 1.01, Fault::kNone, kTick, state);
  EXPECT_EQ(fast.force, glm::dvec3(0.0));
  EXPECT_EQ(fast.fault, Fault::kTooFast);
  const LimitedForce after = LimitForce(options, {2, 0, 0}, 0.1, Fault::kNone, kTick, state);
  EXPECT_LT(glm::length(after.force), 0.01);
}

}  // namespace
}  // namespace arthro::simulation
