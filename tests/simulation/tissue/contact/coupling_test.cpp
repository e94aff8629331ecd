// What the servo is told, against dense algebra on a small linear body: A x = f + contacts, solved
// with each contact open or closed as it must be, for the tool where it was and where it went.
#include "simulation/tissue/contact/coupling.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

constexpr double kSpring = 500.0;

glm::dvec3 AnyUnit(Random& random) {
  const auto u = [&] { return random.Uniform(-1, 1); };
  return glm::normalize(glm::dvec3(u(), u(), u()) + glm::dvec3(1e-6));
}

// Nodes on a ring, each held by a spring to ground and to all others: stiffness as of probed
// tissue.
struct LinearBody {
  LinearBody(int node_count, double ground, double tie, Random& random)
      : a(Eigen::MatrixXd::Zero(3 * node_count, 3 * node_count)), count(node_count) {
    const auto spring = [&](int i, int j, double k) {
      const glm::dvec3 d = AnyUnit(random);
      Eigen::Matrix3d m = 0.3 * k * Eigen::Matrix3d::Identity();
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) m(r, c) += 0.7 * k * d[r] * d[c];
      a.block<3, 3>(3 * i, 3 * i) += m;
      if (j < 0) return;
      a.block<3, 3>(3 * j, 3 * j) += m;
      a.block<3, 3>(3 * i, 3 * j) -= m;
      a.block<3, 3>(3 * j, 3 * i) -= m;
    };
    for (int i = 0; i < count; ++i) {
      spring(i, -1, ground);
      for (int j = 0; j < i; ++j) spring(i, j, tie);
    }
  }
  Eigen::MatrixXd a;  // N/m
  int count;
};

// Contacts whose nodes are at rest at zero displacement; tool displacement moves their feet.
struct Solved {
  std::vector<ContactResult> results;
  glm::dvec3 on_tool{0.0};
  glm::dmat3 stiffness{0.0};
};

Solved Solve(const LinearBody& body, const std::vector<ContactPoint>& contacts,
             const glm::dvec3& tool) {
  const auto n3 = body.a.rows();
  std::vector<bool> closed(contacts.size(), true);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n3);
  Eigen::MatrixXd system;
  const auto row = [&](const ContactPoint& c) {
    Eigen::VectorXd jn = Eigen::VectorXd::Zero(n3);
    for (int k = 0; k < c.count; ++k)
      for (int d = 0; d < 3; ++d) jn[3 * c.node[k] + d] += c.weight[k] * c.normal[d];
    return jn;
  };
  const auto free_gap = [&](const ContactPoint& c) {
    return -glm::dot(c.normal, c.foot + tool);  // at x = 0
  };
  for (int round = 0; round < 50; ++round) {
    system = body.a;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(n3);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (!closed[i]) continue;
      const Eigen::VectorXd jn = row(contacts[i]);
      system += contacts[i].stiffness * jn * jn.transpose();
      load -= contacts[i].stiffness * free_gap(contacts[i]) * jn;
    }
    x = system.ldlt().solve(load);
    bool is_same = true;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const bool now = free_gap(contacts[i]) + row(contacts[i]).dot(x) < 0.0;
      is_same = is_same && now == closed[i];
      closed[i] = now;
    }
    if (is_same) break;
  }
  Solved solved;
  Eigen::Matrix3d k = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n3, 3);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactPoint& c = contacts[i];
    ContactResult result;
    result.gap = free_gap(c) + row(c).dot(x);
    result.force = closed[i] ? -c.stiffness * result.gap * c.normal : glm::dvec3(0.0);
    solved.on_tool -= result.force;
    solved.results.push_back(result);
    if (!closed[i]) continue;
    const Eigen::Vector3d n(c.normal.x, c.normal.y, c.normal.z);
    k += c.stiffness * n * n.transpose();
    b += c.stiffness * row(c) * n.transpose();
  }
  k -= b.transpose() * system.ldlt().solve(b);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) solved.stiffness[c][r] = k(r, c);
  return solved;
}

// `spread`: how far the normals lean from −z, rad.
std::vector<ContactPoint> Patch(const LinearBody& body, int count, double depth, double spread,
                                Random& random) {
  std::vector<ContactPoint> contacts;
  for (int i = 0; i < count; ++i) {
    ContactPoint c;
    c.count = 3;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      c.node[k] = (i + k) % body.count;
      sum += c.weight[k] = random.Uniform(0.2, 1.0);
    }
    for (int k = 0; k < 3; ++k) c.weight[k] /= sum;
    const glm::dvec3 lean = AnyUnit(random);
    c.normal =
        glm::normalize(glm::dvec3(0, 0, -1) + std::tan(spread) * glm::dvec3(lean.x, lean.y, 0));
    c.foot = c.normal * depth;  // the tissue's point at rest is depth above it
    c.stiffness = kSpring / count;
    c.owner = 3;
    contacts.push_back(c);
  }
  return contacts;
}

ToolCoupling CouplingOf(const std::vector<ContactPoint>& contacts, const Solved& solved,
                        const glm::dquat& turn = {1, 0, 0, 0}) {
  ToolCoupling coupling;
  coupling.step = 1;
  coupling.tip = {0.01, 0.02, 0.03};
  AddContacts(contacts, solved.results, 3, solved.stiffness, kSpring, turn, 5, coupling);
  return coupling;
}

TEST(Coupling, AtItsOwnTipItIsTheForceOfTheStep) {
  Random random(11);
  const LinearBody body(12, 300, 200, random);
  const auto contacts = Patch(body, 6, 1e-3, 0.3, random);
  const Solved solved = Solve(body, contacts, {});
  const ToolCoupling coupling = CouplingOf(contacts, solved);
  const CoupledForce force = ForceOf(coupling, coupling.tip);
  EXPECT_LT(glm::length(force.force - solved.on_tool), 1e-12);
  EXPECT_EQ(force.tissue, 5);
}

TEST(Coupling, ContactsShareTheToolsStiffnessExactlyAndAreEachPositive) {
  Random random(12);
  for (int trial = 0; trial < 50; ++trial) {
    const LinearBody body(12, random.Uniform(50, 3000), random.Uniform(10, 500), random);
    const auto contacts = Patch(body, 1 + trial % 8, 1e-3, random.Uniform(0, 1.2), random);
    const Solved solved = Solve(body, contacts, {});
    const glm::dquat turn = glm::angleAxis(random.Uniform(0, 3), AnyUnit(random));
    const ToolCoupling coupling = CouplingOf(contacts, solved, turn);
    const glm::dmat3 r = glm::mat3_cast(turn);
    glm::dmat3 sum(0.0);
    for (int i = 0; i < coupling.count; ++i) {
      const glm::dmat3& k = coupling.contact[i].stiffness;
      if (glm::dot(coupling.contact[i].force, coupling.contact[i].normal) > 0) sum += k;
      for (int c = 0; c < 3; ++c)
        for (int row = 0; row < 3; ++row) EXPECT_EQ(k[c][row], k[row][c]);
      for (int d = 0; d < 20; ++d) {
        const glm::dvec3 way = AnyUnit(random);
        EXPECT_GE(glm::dot(way, k * way), -1e-9);
      }
    }
    const glm::dmat3 expected = r * solved.stiffness * glm::transpose(r);
    for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(sum[c] - expected[c]), 1e-6 * kSpring);
  }
}

// The bridge between steps, on a tissue that is linear and only its contacts are not. The hand may
// go 3 mm in a frame at 0.2 m/s; 1 mm at a brisk 60 mm/s.
TEST(Coupling, AHandThatMovesFeelsWhatTheWholeSolveWouldGive) {
  struct Row {
    const char* name;
    double spread, bound;  // largest error of the force over its size, at 1 mm of motion inwards
  };
  // Of one normal the bridge is exact. Of several, parts across a normal that friction cannot hold
  // are cut off, and contacts open and close: 2 % [notes on deformables, 8, target 6].
  for (const Row& row : {Row{"one normal", 0.0, 1e-6}, Row{"normals within 10°", 0.17, 0.02},
                         Row{"normals within 45°", 0.79, 0.02}}) {
    Random random(13);
    std::array<double, 4> worst{};
    constexpr std::array<double, 4> kWays{1e-4, 5e-4, 1e-3, 3e-3};
    for (int trial = 0; trial < 40; ++trial) {
      const LinearBody body(12, 500, 300, random);
      const auto contacts = Patch(body, 6, 2e-3, row.spread, random);
      const ToolCoupling coupling = CouplingOf(contacts, Solve(body, contacts, {}));
      for (std::size_t w = 0; w < kWays.size(); ++w) {
        glm::dvec3 way = AnyUnit(random);
        if (way.z > 0) way.z = -way.z;  // not out of the tissue
        way *= kWays[w];
        const glm::dvec3 full = Solve(body, contacts, way).on_tool;
        const glm::dvec3 servo = ForceOf(coupling, coupling.tip + way).force;
        worst[w] = std::max(worst[w], glm::length(servo - full) / glm::length(full));
      }
    }
    std::printf("%s: error at 0.1 / 0.5 / 1 / 3 mm: %.2e %.2e %.2e %.2e\n", row.name, worst[0],
                worst[1], worst[2], worst[3]);
    EXPECT_LT(worst[2], row.bound) << row.name;
  }
}

TEST(Coupling, ToolsThatPullAwayAreLetGo) {
  Random random(14);
  const LinearBody body(12, 500, 300, random);
  const auto contacts = Patch(body, 4, 1e-3, 0.1, random);
  const ToolCoupling coupling = CouplingOf(contacts, Solve(body, contacts, {}));
  EXPECT_EQ(ForceOf(coupling, coupling.tip + glm::dvec3(0, 0, 0.005)).force, glm::dvec3(0.0));
  EXPECT_EQ(ForceOf(coupling, coupling.tip + glm::dvec3(0, 0, 0.005)).tissue, -1);
}

TEST(Coupling, AnOpenContactPushesOnceItsWayIsGone) {
  Random random(15);
  const LinearBody body(12, 500, 300, random);
  const auto contacts = Patch(body, 1, -4e-4, 0.0, random);  // 0.4 mm above the tissue
  const ToolCoupling coupling = CouplingOf(contacts, Solve(body, contacts, {}));
  ASSERT_EQ(coupling.count, 1);
  const auto push = [&](double way) {
    return ForceOf(coupling, coupling.tip + glm::dvec3(0, 0, -way)).force.z;
  };
  EXPECT_EQ(push(0.0), 0.0);
  EXPECT_EQ(push(3.9e-4), 0.0);
  EXPECT_GT(push(5e-4), 0.0);
  EXPECT_LE(push(5e-4), kSpring * 1e-4);
}

TEST(Coupling, FrictionIsLimitedByTheNormalForce) {
  ToolCoupling coupling;
  coupling.count = 1;
  coupling.contact[0].force = {0.02, 0, 1};
  coupling.contact[0].normal = {0, 0, 1};
  coupling.contact[0].stiffness = glm::dmat3(300.0);
  coupling.contact[0].friction = 0.03;
  for (double way : {0.0, 1e-5, 1e-4, 1e-3}) {
    const glm::dvec3 force = ForceOf(coupling, {-way, 0, 0}).force;
    EXPECT_NEAR(force.z, 1.0, 1e-12);
    EXPECT_NEAR(force.x, std::min(0.03, 0.02 + 300 * way), 1e-12);
  }
}

// Stiffness from outside may be anything: what the servo gets is symmetric and between 0 and k.
TEST(Coupling, AStiffnessThatCouldGiveEnergyIsClamped) {
  Random random(16);
  const LinearBody body(12, 500, 300, random);
  const auto contacts = Patch(body, 5, 1e-3, 0.4, random);
  Solved solved = Solve(body, contacts, {});
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) solved.stiffness[c][r] = random.Uniform(-3000, 3000);
  const ToolCoupling coupling = CouplingOf(contacts, solved);
  glm::dmat3 sum(0.0);
  for (int i = 0; i < coupling.count; ++i) sum += coupling.contact[i].stiffness;
  for (int d = 0; d < 200; ++d) {
    const glm::dvec3 way = AnyUnit(random);
    const double k = glm::dot(way, sum * way);
    EXPECT_GE(k, -1e-9);
    EXPECT_LE(k, kSpring * (1 + 1e-9));
  }
}

TEST(Coupling, WhatIsNotANumberIsFaultyAndGivesNoForce) {
  Random random(17);
  const LinearBody body(12, 500, 300, random);
  const auto contacts = Patch(body, 3, 1e-3, 0.1, random);
  Solved solved = Solve(body, contacts, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ForceOf(CouplingOf(contacts, solved), glm::dvec3(nan)).force, glm::dvec3(0.0));
  Solved bad = solved;
  bad.stiffness[1][1] = nan;
  EXPECT_TRUE(CouplingOf(contacts, bad).is_faulty);
  bad = solved;
  bad.results[0].force.x = nan;
  const ToolCoupling faulty = CouplingOf(contacts, bad);
  EXPECT_TRUE(faulty.is_faulty || IsFinite(faulty));
  EXPECT_TRUE(std::isfinite(ForceOf(faulty, faulty.tip).force.x));
}

// A hand at 0.2 m/s; a step of the tissue every frame, one missed, and one that ends the contact.
TEST(CouplingBlend, TheForceIsContinuousThroughStepsThatComeLateOrEarly) {
  constexpr double kTick = 0.001, kFrame = 1.0 / 60, kSpeed = 0.2;
  Random random(18);
  const LinearBody body(12, 400, 200, random);
  const auto contacts = Patch(body, 5, 1e-3, 0.2, random);
  CouplingBlend blend;
  glm::dvec3 last(0.0);
  double largest = 0, largest_level = 0, next = 0;
  const auto tip_at = [&](double t) {
    return glm::dvec3(0.01, 0.02, 0.03 - 1e-3 * std::sin(kSpeed / 1e-3 * t));
  };
  std::uint64_t step = 0;
  double largest_change = 0;  // between couplings, at the tip when the new one came
  for (int tick = 0; tick < 600; ++tick) {
    const double t = tick * kTick;
    if (t >= next) {
      const Solved solved = Solve(body, contacts, tip_at(t) - glm::dvec3(0.01, 0.02, 0.03));
      ToolCoupling coupling;
      coupling.step = ++step;
      coupling.tip = tip_at(t);
      if (step % 9 != 0)
        AddContacts(contacts, solved.results, 3, solved.stiffness, kSpring, {1, 0, 0, 0}, 5,
                    coupling);
      if (tick > 0)
        largest_change =
            std::max(largest_change, glm::length(ForceOf(coupling, blend.tip).force - last));
      TakeCoupling(blend, coupling);
      next += step % 7 == 0 ? 2 * kFrame : step % 5 == 0 ? 0.5 * kFrame : kFrame;
    }
    const glm::dvec3 force = BlendedForce(blend, tip_at(t), kTick, kFrame).force;
    if (tick > 0) largest = std::max(largest, glm::length(force - last));
    largest_level = std::max(largest_level, glm::length(force));
    last = force;
  }
  // A tick changes it by what the hand moved against the spring, and by a frame's part of the
  // change from one coupling to the next.
  const double bound = kSpring * kSpeed * kTick + largest_change * kTick / kFrame;
  std::printf("blend: largest step %.4f N of %.2f N, bound %.4f N\n", largest, largest_level,
              bound);
  EXPECT_GT(largest_level, 0.1);
  EXPECT_LT(largest, bound);
}

TEST(CouplingBlend, AFaultEndsTheForceAtOnceAndWhatComesAfterBeginsAnew) {
  Random random(19);
  const LinearBody body(12, 400, 200, random);
  const auto contacts = Patch(body, 5, 1e-3, 0.2, random);
  const ToolCoupling good = CouplingOf(contacts, Solve(body, contacts, {}));
  CouplingBlend blend;
  TakeCoupling(blend, good);
  for (int i = 0; i < 20; ++i) BlendedForce(blend, good.tip, 0.001, 0.0167);
  EXPECT_GT(glm::length(BlendedForce(blend, good.tip, 0.001, 0.0167).force), 0.1);
  ToolCoupling bad = good;
  bad.contact[0].stiffness[0][0] = std::numeric_limits<double>::quiet_NaN();
  TakeCoupling(blend, bad);
  EXPECT_EQ(BlendedForce(blend, good.tip, 0.001, 0.0167).force, glm::dvec3(0.0));
  EXPECT_TRUE(blend.to.is_faulty);
  TakeCoupling(blend, good);
  const double first = glm::length(BlendedForce(blend, good.tip, 0.001, 0.0167).force);
  EXPECT_LT(first, 0.07 * glm::length(ForceOf(good, good.tip).force)) << "a sixteenth of a frame";
}

TEST(CouplingBlend, ATissueThatFallsSilentFades) {
  Random random(20);
  const LinearBody body(12, 400, 200, random);
  const auto contacts = Patch(body, 5, 1e-3, 0.2, random);
  const ToolCoupling good = CouplingOf(contacts, Solve(body, contacts, {}));
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
  Random random(21);
  const LinearBody body(12, 400, 200, random);
  const auto contacts = Patch(body, 8, 1e-3, 0.2, random);
  const Solved solved = Solve(body, contacts, {});
  CouplingBlend blend;
  const long before = test::Allocations();
  for (int i = 0; i < 100; ++i) {
    TakeCoupling(blend, CouplingOf(contacts, solved));
    BlendedForce(blend, {0.01, 0.02, 0.03 - 1e-5 * i}, 0.001, 0.0167);
  }
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace arthro::simulation
