// Coupling of the servo, compared with surfaces whose answer is known in closed form.
#include "simulation/tissue/contact/coupling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

constexpr double kSpring = 500.0;

glm::dvec3 AnyUnit(Random& random) {
  const auto u = [&] { return random.Uniform(-1, 1); };
  return glm::normalize(glm::dvec3(u(), u(), u()) + glm::dvec3(1e-6));
}

// Tissue whose skin is a ball of radius `ball` about `centre` (negative: a hollow). A tip below the
// skin feels k (depth)^p / p δ^(p − 1) along the normal.
struct Bulge {
  glm::dvec3 centre{0.0};
  double ball = 0.02, k = 300, power = 1, unit = 1e-3;
  glm::dvec3 Normal(const glm::dvec3& tip) const {
    return glm::normalize(tip - centre) * (ball > 0 ? 1.0 : -1.0);
  }
  double Depth(const glm::dvec3& tip) const {
    return ball > 0 ? ball - glm::distance(tip, centre) : glm::distance(tip, centre) + ball;
  }
  glm::dvec3 Force(const glm::dvec3& tip) const {
    const double x = Depth(tip);
    return x > 0 ? k * unit / power * std::pow(x / unit, power) * Normal(tip) : glm::dvec3(0.0);
  }
};

// Coupling that a step of such a tissue would give, with its tool on one contact.
ToolCoupling CouplingOf(const Bulge& bulge, const glm::dvec3& tip,
                        const glm::dquat& turn = {1, 0, 0, 0}, double friction = 0.0,
                        const glm::dvec3& rub = glm::dvec3(0.0)) {
  const glm::dquat back = glm::conjugate(turn);
  const glm::dvec3 normal = back * bulge.Normal(tip);
  ContactPoint contact;
  contact.owner = 3;
  contact.normal = -normal;
  contact.friction = friction;
  ContactResult result;
  result.push = -(back * bulge.Force(tip));
  result.force = result.push - back * rub;
  result.gap = -bulge.Depth(tip);
  const double x = bulge.Depth(tip);
  const double k = x > 0 ? bulge.k * std::pow(x / bulge.unit, bulge.power - 1) : bulge.k;
  TouchedSkin skin;
  skin.stiffness = k;
  skin.curvature = -1.0 / bulge.ball * (glm::dmat3(1.0) - glm::outerProduct(normal, normal));
  skin.depth = std::max(0.0, x);
  ToolCoupling coupling;
  coupling.step = 1;
  coupling.tip = tip;
  AddContacts({&contact, 1}, {&result, 1}, 3, skin, kSpring, turn, 5, coupling);
  return coupling;
}

TEST(Coupling, ForceAtItsOwnTipEqualsTheStepForce) {
  Random random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const glm::dvec3 out = AnyUnit(random);
    const Bulge bulge{{0.01, 0.02, 0.03}, trial % 2 == 0 ? 0.02 : -0.02, 300, random.Uniform(1, 2)};
    const glm::dvec3 tip =
        bulge.centre + (std::abs(bulge.ball) - (bulge.ball > 0 ? 1e-3 : -1e-3)) * out;
    const glm::dvec3 rub = 0.001 * glm::normalize(glm::cross(out, AnyUnit(random)));
    const glm::dquat turn = glm::angleAxis(random.Uniform(0, 3), AnyUnit(random));
    const ToolCoupling coupling = CouplingOf(bulge, tip, turn, 0.03, rub);
    const CoupledForce force = ForceOf(coupling, tip);
    EXPECT_LT(glm::length(force.force - bulge.Force(tip) - rub), 1e-12);
    EXPECT_EQ(force.tissue, 5);
  }
}

// 1.7 mm is the motion per frame at 100 mm/s. Skins range from flat to the bulge of a condyle.
TEST(Coupling, ForceFollowsTheCurvatureOfSlidingContact) {
  Random random(13);
  for (const double ball : {1e3, 0.05, 0.02, -0.02}) {
    std::array<double, 3> worst{};
    constexpr std::array<double, 3> kWays{1e-4, 5e-4, 1.7e-3};
    for (int trial = 0; trial < 200; ++trial) {
      const Bulge bulge{{0, 0, 0}, ball, 150, random.Uniform(1, 2)};
      const glm::dvec3 out = AnyUnit(random);
      const glm::dvec3 tip = (std::abs(ball) - (ball > 0 ? 1e-3 : -1e-3)) * out;
      const ToolCoupling coupling = CouplingOf(bulge, tip);
      for (std::size_t w = 0; w < kWays.size(); ++w) {
        const glm::dvec3 there = tip + kWays[w] * AnyUnit(random);
        const glm::dvec3 full = bulge.Force(there);
        const double size = std::max(glm::length(full), 0.5 * glm::length(bulge.Force(tip)));
        worst[w] = std::max(worst[w], glm::length(ForceOf(coupling, there).force - full) / size);
      }
    }
    std::printf("radius %7.2f m: error at 0.1 / 0.5 / 1.7 mm: %.1e %.1e %.1e\n", ball, worst[0],
                worst[1], worst[2]);
    // Third order in distance over radius, times the force fraction per radian.
    for (std::size_t w = 0; w < kWays.size(); ++w) EXPECT_LT(worst[w], 0.02);
  }
}

// The contact of a step without a solution gives the force that the last one gives at the new tip,
// and its push grows from there as that does. A rub that has slipped goes on from where it is.
TEST(Coupling, MovedContactGivesTheForceOfTheLastAtItsTip) {
  Random random(17);
  double worst = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const glm::dvec3 out = AnyUnit(random);
    const Bulge bulge{{0, 0, 0}, trial % 2 == 0 ? 0.02 : -0.02, 300, random.Uniform(1, 2)};
    const glm::dvec3 tip = (0.02 - (bulge.ball > 0 ? 1e-3 : -1e-3)) * out;
    const glm::dvec3 rub = 0.004 * glm::normalize(glm::cross(out, AnyUnit(random)));
    const bool rubs = trial % 3 == 0;
    const ToolCoupling last =
        CouplingOf(bulge, tip, {1, 0, 0, 0}, rubs ? 0.03 : 0.0, rubs ? rub : glm::dvec3(0.0));
    ToolCoupling moved;
    moved.step = 2;
    moved.tip = tip + random.Uniform(0, 1.5e-3) * AnyUnit(random);
    AddMoved(last.contact[0], moved.tip - tip, moved);
    ASSERT_EQ(moved.count, 1);
    EXPECT_FALSE(moved.is_faulty);
    EXPECT_LT(glm::length(ForceOf(moved, moved.tip).force - ForceOf(last, moved.tip).force), 1e-12)
        << trial;
    if (rubs) continue;
    const glm::dvec3 on = moved.tip + 1e-4 * AnyUnit(random);
    const double size = std::max(0.05, glm::length(ForceOf(last, moved.tip).force));
    worst = std::max(worst, glm::length(ForceOf(moved, on).force - ForceOf(last, on).force) / size);
  }
  std::printf("0.1 mm further: %.2e of the force\n", worst);
  EXPECT_LT(worst, 0.05);
}

TEST(Coupling, ToolThatPullsAwayFeelsNoForce) {
  const Bulge bulge;
  const glm::dvec3 tip(0, 0, 0.019);
  const ToolCoupling coupling = CouplingOf(bulge, tip);
  EXPECT_GT(ForceOf(coupling, tip).force.z, 0.1);
  EXPECT_EQ(ForceOf(coupling, tip + glm::dvec3(0, 0, 0.005)).force, glm::dvec3(0.0));
  EXPECT_EQ(ForceOf(coupling, tip + glm::dvec3(0, 0, 0.005)).tissue, -1);
}

TEST(Coupling, OpenContactPushesAfterItsGapIsClosed) {
  const Bulge bulge;
  const ToolCoupling coupling = CouplingOf(bulge, {0, 0, 0.0204});  // 0.4 mm above the tissue
  ASSERT_EQ(coupling.count, 1);
  const auto push = [&](double way) {
    return ForceOf(coupling, coupling.tip + glm::dvec3(0, 0, -way)).force.z;
  };
  EXPECT_EQ(push(0.0), 0.0);
  EXPECT_EQ(push(3.9e-4), 0.0);
  EXPECT_NEAR(push(5e-4), bulge.k * 1e-4, 1e-9);
}

// For any curvature and tip position, because the session's loop feeds the tip's motion back. No
// force may grow faster than its springs: the push along its normal by h, by rotation h, friction h
// and its normal force.
TEST(Coupling, ForceGrowsNoFasterThanItsSprings) {
  Random random(17);
  double most = 0;
  for (int round = 0; round < 2000; ++round) {
    ContactPoint contact;
    contact.owner = 3;
    const glm::dvec3 normal = AnyUnit(random);
    contact.normal = -normal;
    contact.friction = 0.03;
    ContactResult result;
    result.push = -random.Uniform(0, 5) * normal;
    result.force = result.push;
    result.gap = -1e-4;
    const glm::dvec3 across = glm::normalize(glm::cross(normal, AnyUnit(random)));
    TouchedSkin skin{random.Uniform(-100, 600),
                     random.Uniform(-400, 400) * glm::outerProduct(across, across),
                     random.Uniform(0, 0.01)};
    ToolCoupling coupling;
    coupling.step = 1;
    AddContacts({&contact, 1}, {&result, 1}, 3, skin, kSpring, {1, 0, 0, 0}, 0, coupling);
    ASSERT_FALSE(coupling.is_faulty);
    const double far = std::pow(10.0, random.Uniform(-4, 1));  // m
    const glm::dvec3 a = far * random.Uniform(0, 1) * AnyUnit(random);
    const glm::dvec3 b = a + std::min(far, 1e-3) * random.Uniform(0, 1) * AnyUnit(random);
    const double growth =
        glm::distance(ForceOf(coupling, a).force, ForceOf(coupling, b).force) / glm::distance(a, b);
    most = std::max(most, growth);
    // Far away the push along its normal is large and rotates with the small sideways offset.
    const double turned = glm::length(ForceOf(coupling, a).force) / 2.5e-3;
    EXPECT_LE(growth, 3.0 * kSpring + turned) << "round " << round << ", " << far << " m off";
  }
  std::printf("force grows by at most %.0f N/m, springs of %.0f\n", most, kSpring);
}

TEST(Coupling, FrictionIsLimitedByTheNormalForce) {
  const Bulge flat{{0, 0, -1e3}, 1e3, 300};
  const ToolCoupling coupling = CouplingOf(flat, {0, 0, -1e-3}, {1, 0, 0, 0}, 0.03, {0.002, 0, 0});
  for (double way : {0.0, 1e-6, 1e-5, 1e-4, 1e-3}) {
    const glm::dvec3 force = ForceOf(coupling, coupling.tip - glm::dvec3(way, 0, 0)).force;
    EXPECT_NEAR(force.z, 0.3, 1e-6);
    EXPECT_NEAR(force.x, std::min(0.03 * 0.3, 0.002 + kSpring * way), 1e-6);
  }
}

// The contacts of a wedge push by 1000 N against one another, and their friction bears most of what
// is left. The servo must feel the small sum of the step, not the pushes without their friction.
TEST(Coupling, AWedgedToolFeelsTheForceOfTheStep) {
  constexpr double kFriction = 0.03;
  std::array<ContactPoint, 2> contacts;
  std::array<ContactResult, 2> results;
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::dvec3 push = 500.0 * glm::normalize(glm::dvec3(i == 0 ? 1 : -1, 0, 0.033));
    contacts[i].owner = 3;
    contacts[i].friction = kFriction;
    contacts[i].normal = -glm::normalize(push);
    results[i].push = -push;
    const glm::dvec3 down(i == 0 ? 0.033 : -0.033, 0, -1);
    results[i].force = -(push + kFriction * 500.0 * glm::normalize(down));
  }
  const glm::dvec3 step = -(results[0].force + results[1].force);
  ASSERT_GT(glm::length(results[0].push + results[1].push), 30.0);
  ASSERT_LT(glm::length(step), 4.0);
  ToolCoupling coupling;
  AddContacts(contacts, results, 3, {300.0}, kSpring, {1, 0, 0, 0}, 5, coupling);
  EXPECT_LT(glm::distance(ForceOf(coupling, coupling.tip).force, step), 1e-9);
  for (const double way : {1e-4, 1e-3, 7e-3})  // no faster than the spring, whatever the way
    for (const glm::dvec3& along : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)})
      EXPECT_LT(glm::length(ForceOf(coupling, way * along).force),
                glm::length(step) + kSpring * way);
}

// For any external stiffness the servo's force grows no faster than the spring and never pulls.
TEST(Coupling, StiffnessThatCouldAddEnergyIsClamped) {
  Random random(16);
  for (int trial = 0; trial < 500; ++trial) {
    ContactPoint contact;
    contact.owner = 3;
    contact.normal = {0, 0, -1};
    ContactResult result;
    result.push = result.force = {0, 0, -random.Uniform(0.01, 3)};
    TouchedSkin skin;
    skin.stiffness = random.Uniform(-3000, 3000);
    skin.depth = random.Uniform(0, 0.01);
    ToolCoupling coupling;
    AddContacts({&contact, 1}, {&result, 1}, 3, skin, kSpring, {1, 0, 0, 0}, 5, coupling);
    double last = -1;
    for (double z = 0.01; z > -0.01; z -= 1e-5) {
      const double push = ForceOf(coupling, {0, 0, z}).force.z;
      EXPECT_GE(push, 0.0);
      if (last >= 0) {
        EXPECT_GE(push, last - 1e-12);
        EXPECT_LE(push, last + 1.001 * kSpring * 1e-5);
      }
      last = push;
    }
  }
}

TEST(Coupling, NonFiniteValuesAreFaultyAndGiveNoForce) {
  const Bulge bulge;
  const glm::dvec3 tip(0, 0, 0.019);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ForceOf(CouplingOf(bulge, tip), glm::dvec3(nan)).force, glm::dvec3(0.0));
  for (const int bad : {0, 1, 2, 3, 4}) {
    ContactPoint contact;
    contact.owner = 3;
    ContactResult result;
    result.push = result.force = {0, 0, 1};
    TouchedSkin skin;
    skin.stiffness = bad == 0 ? nan : 300.0;
    if (bad == 1) skin.curvature[0][0] = nan;
    if (bad == 2) skin.depth = nan;
    if (bad == 3) result.push.x = nan;
    if (bad == 4) result.force.x = nan;
    ToolCoupling coupling;
    AddContacts({&contact, 1}, {&result, 1}, 3, skin, kSpring, {1, 0, 0, 0}, 5, coupling);
    EXPECT_TRUE(coupling.is_faulty) << bad;
    EXPECT_EQ(ForceOf(coupling, {0, 0, 1e-3}).force, glm::dvec3(0.0));
  }
}

// Hand at 0.2 m/s; one tissue step per frame, one missing, and one that ends the contact.
TEST(CouplingBlend, ForceIsContinuousForLateAndEarlySteps) {
  constexpr double kSpeed = 0.2;
  const Bulge bulge{{0.01, 0.02, 0.01}, 0.0205, 300, 1.3};
  CouplingBlend blend;
  glm::dvec3 last(0.0);
  double largest = 0, largest_level = 0, next = 0;
  const auto tip_at = [&](double t) {
    return glm::dvec3(0.01, 0.02, 0.03 - 1e-3 * std::sin(kSpeed / 1e-3 * t));
  };
  std::uint64_t step = 0;
  double largest_change = 0;  // between couplings, at the tip when the new one arrived
  for (int tick = 0; tick < 600; ++tick) {
    const double t = tick * test::kTick;
    if (t >= next) {
      ToolCoupling coupling = CouplingOf(bulge, tip_at(t));
      coupling.step = ++step;
      if (step % 9 == 0) coupling.count = 0;
      if (tick > 0)
        largest_change =
            std::max(largest_change, glm::length(ForceOf(coupling, blend.tip).force - last));
      TakeCoupling(blend, coupling);
      next += step % 7 == 0 ? 2 * test::kFrame : step % 5 == 0 ? 0.5 * test::kFrame : test::kFrame;
    }
    const glm::dvec3 force = BlendedForce(blend, tip_at(t), test::kTick, test::kFrame).force;
    if (tick > 0) largest = std::max(largest, glm::length(force - last));
    largest_level = std::max(largest_level, glm::length(force));
    last = force;
  }
  // Bound per tick: the hand's motion against the spring, and a frame's fraction of the change
  // between couplings.
  const double bound = kSpring * kSpeed * test::kTick + largest_change * test::kTick / test::kFrame;
  std::printf("blend: largest step %.4f N of %.2f N, bound %.4f N\n", largest, largest_level,
              bound);
  EXPECT_GT(largest_level, 0.1);
  EXPECT_LT(largest, bound);
}

TEST(CouplingBlend, FaultEndsTheForceAtOnceAndTheNextCouplingStartsAnew) {
  const ToolCoupling good = CouplingOf(Bulge{}, {0, 0, 0.019});
  CouplingBlend blend;
  TakeCoupling(blend, good);
  for (int i = 0; i < 20; ++i) BlendedForce(blend, good.tip, 0.001, 0.0167);
  EXPECT_GT(glm::length(BlendedForce(blend, good.tip, 0.001, 0.0167).force), 0.1);
  ToolCoupling bad = good;
  bad.contact[0].stiffness = std::numeric_limits<double>::quiet_NaN();
  TakeCoupling(blend, bad);
  EXPECT_EQ(BlendedForce(blend, good.tip, 0.001, 0.0167).force, glm::dvec3(0.0));
  EXPECT_TRUE(blend.to.is_faulty);
  TakeCoupling(blend, good);
  const double first = glm::length(BlendedForce(blend, good.tip, 0.001, 0.0167).force);
  EXPECT_LT(first, 0.07 * glm::length(ForceOf(good, good.tip).force))
      << "one of sixteen ticks per frame";
}

TEST(CouplingBlend, ForceFadesWithoutNewCouplings) {
  const ToolCoupling good = CouplingOf(Bulge{}, {0, 0, 0.019});
  CouplingBlend blend;
  TakeCoupling(blend, good);
  const double full = glm::length(ForceOf(good, good.tip).force);
  for (int i = 1; i <= 200; ++i) {
    const double force = glm::length(BlendedForce(blend, good.tip, 0.001, 0.0167).force);
    if (i >= 20 && i <= 99) {
      EXPECT_NEAR(force, full, 1e-9);
    }
    if (i > 150) {
      EXPECT_EQ(force, 0.0);
    }
  }
}

TEST(CouplingBlend, AllocatesNothing) {
  const Bulge bulge;
  CouplingBlend blend;
  const long before = test::Allocations();
  for (int i = 0; i < 100; ++i) {
    TakeCoupling(blend, CouplingOf(bulge, {0, 0, 0.019}));
    BlendedForce(blend, {0, 0, 0.019 - 1e-5 * i}, 0.001, 0.0167);
  }
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace arthro::simulation
