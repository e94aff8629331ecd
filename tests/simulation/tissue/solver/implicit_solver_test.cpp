#include "simulation/tissue/solver/implicit_solver.h"

#include <cmath>
#include <ctime>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/simulation/tissue/solver/solver_bodies.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::LargestDistance;
using test::Meniscus;
using test::PressAt;
using test::SolverBody;

using test::kFrame;

double CpuMs() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

TEST(ImplicitSolver, BodyAtRestStaysBitForBit) {
  const SolverBody body = Meniscus(2, {24, 4, 1});
  ImplicitSolver solver(body.model, body.fixed);
  BodyState state = body.Rest();
  for (int step = 0; step < 3; ++step) {
    const StepReport report = solver.Step(state, body.load, {}, {}, kFrame, {});
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.iterations, 0);
  }
  EXPECT_EQ(state.x, body.mesh.rest_positions);
}

TEST(ImplicitSolver, FreeBodyFallsAsImplicitEulerPredicts) {
  SolverBody body = test::MakeBody(test::BlockMesh(2, {2, 2, 2}), "", test::MeniscusMaterial());
  for (std::size_t i = 0; i < body.load.size(); ++i) body.load[i].z = -9.81 * body.model->mass()[i];
  SolverOptions options;
  options.tolerance = 1e-9;
  options.max_newton = 10;
  ImplicitSolver solver(body.model, {}, options);
  BodyState state = body.Rest();
  constexpr int kSteps = 30;
  for (int step = 0; step < kSteps; ++step) solver.Step(state, body.load, {}, {}, kFrame, {});
  // x = −g dt² (1 + 2 + … + n) without deformation, up to the summed tolerance.
  const double fall = 9.81 * kFrame * kFrame * kSteps * (kSteps + 1) / 2;
  for (std::size_t i = 0; i < state.x.size(); ++i)
    EXPECT_NEAR((body.mesh.rest_positions[i].z - state.x[i].z) / fall, 1, 1e-7);
}

// Goal: one or two steps from rest to 5 %. Times are printed only.
TEST(ImplicitSolver, StepLoadIsWithinFivePercentAfterThreeFrames) {
  for (const auto& [name, order, cells] : {std::tuple{"T4 S", 1, test::Cells{24, 4, 2}},
                                           {"T4 M", 1, test::Cells{48, 8, 4}},
                                           {"T10 576", 2, test::Cells{24, 4, 1}}}) {
    const SolverBody body = Meniscus(order, cells, -0.05);
    ImplicitSolver exact(body.model, body.fixed), solver(body.model, body.fixed);
    BodyState rest = body.Rest(), state = body.Rest();
    ASSERT_TRUE(exact.SolveStatic(rest, body.load, {}, {}, 1e-10, {}).converged);
    const double answer = body.MeanZ("patch", rest.x);
    double ms = 0, five_ms = 0, one_ms = 0;
    int five = 0, one = 0, most_iterations = 0;
    for (int step = 1; step <= 12; ++step) {
      const double begin = CpuMs();
      const StepReport report = solver.Step(state, body.load, {}, {}, kFrame, {});
      ms += CpuMs() - begin;
      most_iterations = std::max(most_iterations, report.iterations);
      const double error = std::abs(body.MeanZ("patch", state.x) / answer - 1);
      if (error > 0.05) five = 0;
      if (error > 0.01) one = 0;
      if (error <= 0.05 && five == 0) five = step, five_ms = ms;
      if (error <= 0.01 && one == 0) one = step, one_ms = ms;
    }
    const double error = LargestDistance(state.x, rest.x) / -answer;
    fmt::print(
        "{:8} to 5 %: {} steps, {:.1f} ms; to 1 %: {} steps, {:.1f} ms CPU; after 12 steps error "
        "{:.1e}; at most {} cg per step\n",
        name, five, five_ms, one, one_ms, error, most_iterations);
    EXPECT_LE(five, 3) << name;  // the softer T10 rings once by 5.4 % in the second frame
    EXPECT_LE(one, 4) << name;
    EXPECT_LE(error, 1e-4) << name;  // final solver error at most 0.01 % [benchmarks.md, Goals]
    EXPECT_LE(most_iterations, 20) << name;
  }
}

TEST(ImplicitSolver, StepAllocatesNothing) {
  const SolverBody body = Meniscus(2, {24, 4, 1}, -0.05);
  ImplicitSolver solver(body.model, body.fixed);
  BodyState state = body.Rest();
  std::vector<ContactPoint> contacts;
  for (int i = 0; i < 5; ++i)
    contacts.push_back(
        PressAt(body, state.x, {0.0137 + 1e-3 * i, 0, 0.002}, {0, 0, -1}, 500, 5e-4));
  for (ContactPoint& contact : contacts) contact.friction = 0.03, contact.hold = 500;
  std::vector<ContactResult> results(contacts.size());
  for (int step = 0; step < 3; ++step) solver.Step(state, body.load, contacts, {}, kFrame, results);
  const long before = test::Allocations();
  for (int step = 0; step < 6; ++step) {
    for (ContactPoint& contact : contacts) contact.foot.z -= 2e-4;
    solver.Step(state, body.load, contacts, {}, kFrame, results);
    solver.ToolStiffness(0, {0, 0, -1}, 3e-2);
    for (glm::dvec3& x : state.x) x.z += step == 3 ? 1e-3 * std::sin(1e4 * x.x) : 0;  // a bad start
  }
  EXPECT_EQ(test::Allocations() - before, 0);
}

TEST(ImplicitSolver, ContactBalancesItsSpring) {
  const SolverBody body = Meniscus(2, {24, 4, 1});
  ImplicitSolver solver(body.model, body.fixed);
  BodyState state = body.Rest();
  const ContactPoint contact = PressAt(body, state.x, {0.0137, 0, 0.0025}, {0, 0, -1}, 500, 1e-3);
  ContactResult result;
  const StepReport report = solver.SolveStatic(state, {}, {&contact, 1}, {}, 1e-9, {&result, 1});
  EXPECT_TRUE(report.converged);
  EXPECT_LT(result.gap, 0);
  EXPECT_NEAR(result.force.z, 500 * result.gap, 1e-12);
  glm::dvec3 held(0.0);
  for (const glm::dvec3& r : solver.reactions()) held += r;
  EXPECT_NEAR(held.z, -result.force.z, 1e-8 * std::abs(result.force.z));
  fmt::print("pushed 1 mm by 500 N/m: {:.4f} N, tissue yielded {:.3f} mm\n", -result.force.z,
             1 + 1e3 * result.gap);
}

TEST(ImplicitSolver, FrictionSticksInsideItsConeAndSlipsBeyond) {
  const SolverBody body = Meniscus(2, {24, 4, 1});
  for (const double mu : {0.02, 5.0}) {
    ImplicitSolver solver(body.model, body.fixed);
    BodyState state = body.Rest();
    ContactPoint contact = PressAt(body, state.x, {0.0137, 0, 0.0025}, {0, 0, -1}, 500, 1e-3);
    contact.friction = mu;
    contact.start.x += 5e-5;  // the touching object moved sideways
    ContactResult result;
    for (int step = 0; step < 30; ++step)
      solver.Step(state, {}, {&contact, 1}, {}, kFrame, {&result, 1});
    const double normal = -result.force.z, sideways = result.force.x;
    EXPECT_GT(sideways, 0);
    if (mu < 1) {
      EXPECT_NEAR(sideways / normal, mu, 1e-3 * mu);  // slips: on the cone
    } else {
      EXPECT_LT(sideways / normal, 0.9 * mu);  // sticks
      EXPECT_NEAR(result.point.x, contact.start.x, contact.slip_scale);
    }
  }
}

class ToolStiffness : public testing::TestWithParam<bool> {};

// Directions that determine a symmetric matrix.
constexpr std::array<glm::dvec3, 6> kWays{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}};

// Half spaces, or round bars with rotating normals; all on one tool on its hand's spring.
TEST_P(ToolStiffness, EqualsTheDerivativeOfTheForce) {
  const SolverBody body = Meniscus(2, {24, 4, 1});
  ImplicitSolver solver(body.model, body.fixed);
  BodyState state = body.Rest();
  std::vector<ContactPoint> contacts;
  for (int i = 0; i < 3; ++i) {
    contacts.push_back(
        PressAt(body, state.x, {0.0137 + 2e-3 * i, 0, 0.0025}, {0, 0, -1}, 500, 1e-3));
    ContactPoint& contact = contacts.back();
    contact.normal = glm::normalize(glm::dvec3(0.3 * (i - 1), 0.1, -1));
    contact.hold = 500;
    if (!GetParam()) continue;
    contact.is_round = true;
    contact.radius = 1e-3;
    contact.a = contact.b = contact.foot - contact.radius * contact.normal;
    contact.b.x += 2e-3;
  }
  std::vector<ContactResult> results(3);
  const auto force_at = [&](const glm::dvec3& moved) {
    std::vector<ContactPoint> there = contacts;
    for (ContactPoint& contact : there)
      contact.foot += moved, contact.a += moved, contact.b += moved;
    BodyState now = state;
    EXPECT_TRUE(solver.SolveStatic(now, {}, there, {}, 1e-9, results).converged);
    glm::dvec3 sum(0.0);
    for (const ContactResult& result : results) sum -= result.force;  // on the tool
    return sum;
  };
  constexpr double kMove = 1e-6;  // m
  glm::dmat3 measured(0.0);
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 move(0.0);
    move[c] = kMove;
    measured[c] = -(force_at(move) - force_at(-move)) / (2 * kMove);
  }
  ASSERT_TRUE(solver.SolveStatic(state, {}, contacts, {}, 1e-9, results).converged);
  const double begin = CpuMs();
  constexpr double kTolerance = 3e-2;
  const double along_z = solver.ToolStiffness(0, {0, 0, 1}, kTolerance);
  const double ms = CpuMs() - begin;
  double off = 0, size = 0;
  for (const glm::dvec3& way : kWays) {
    const glm::dvec3 n = glm::normalize(way);
    off =
        std::max(off, std::abs(solver.ToolStiffness(0, n, kTolerance) - glm::dot(n, measured * n)));
    size = std::max(size, glm::length(measured * n));
  }
  fmt::print("tool stiffness {:.1f} N/m along z, off by {:.1e}; {:.2f} ms CPU for {} T10\n",
             along_z, off / size, ms, body.mesh.ElementCount());
  // Square of the tolerance, relative to the hand's 500 N/m, of which 48 N/m remain.
  if (!GetParam()) {
    EXPECT_LE(off / size, kTolerance * kTolerance * 500 / size);
  }
  EXPECT_LE(off / size, 2e-2);  // the servo's force must be within 2 % [benchmarks.md, Goals]
  EXPECT_EQ(solver.ToolStiffness(1, {0, 0, 1}, kTolerance), 0.0);  // no such owner

  // One step later the result only serves as a starting value.
  for (ContactPoint& contact : contacts) {
    const glm::dvec3 on(3e-4, 0, -1e-4);
    contact.foot += on, contact.a += on, contact.b += on;
  }
  ASSERT_TRUE(solver.SolveStatic(state, {}, contacts, {}, 1e-9, results).converged);
  for (const glm::dvec3& way : kWays) {
    const glm::dvec3 n = glm::normalize(way);
    const double later = solver.ToolStiffness(0, n, kTolerance);
    EXPECT_NEAR(later, solver.ToolStiffness(0, n, 1e-7), kTolerance * kTolerance * 500);
  }
}

INSTANTIATE_TEST_SUITE_P(FlatAndRound, ToolStiffness, testing::Values(false, true));

TEST(ImplicitSolver, RefreshedFactorSavesIterationsAndChangesNoResult) {
  const SolverBody body = Meniscus(2, {24, 4, 1});
  SolverOptions options;
  options.tolerance = 1e-6;
  ImplicitSolver old_factor(body.model, body.fixed, options),
      fresh(body.model, body.fixed, options);
  BodyState a = body.Rest(), b = body.Rest();
  const ContactPoint contact = PressAt(body, a.x, {0.0137, 0, 0.0025}, {0, 0, -1}, 5e4, 4e-3);
  int with_old = 0, with_new = 0;
  for (int step = 0; step < 20; ++step) {
    const StepReport one = old_factor.Step(a, {}, {&contact, 1}, {}, kFrame, {});
    const StepReport two = fresh.Step(b, {}, {&contact, 1}, {}, kFrame, {});
    if (step == 5) {
      EXPECT_FALSE(fresh.TakeRefreshed());
      EXPECT_EQ(fresh.factor_age(), 6);
      fresh.BeginRefresh();
      fresh.RunRefresh();
      EXPECT_TRUE(fresh.TakeRefreshed());
      EXPECT_EQ(fresh.factor_age(), 0);
    }
    if (step > 5) {
      with_old += one.iterations;
      with_new += two.iterations;
    }
    EXPECT_LE(LargestDistance(a.x, b.x), 1e-5 * body.Diagonal());
  }
  fmt::print("cg iterations in 14 steps: {} with the rest factor, {} with a new one\n", with_old,
             with_new);
  EXPECT_LT(with_new, with_old);
}

// The iterations that the old factor needs after a complete cut are printed only.
TEST(ImplicitSolver, BodyCutInTwoContinuesUntilANewFactor) {
  SolverBody body = Meniscus(2, {24, 4, 1}, -0.05);
  ImplicitSolver solver(body.model, body.fixed);
  BodyState state = body.Rest();
  for (int step = 0; step < 5; ++step) solver.Step(state, body.load, {}, {}, kFrame, {});
  // Elements beyond y = 4 mm get separate nodes: a cut through the body.
  TetMesh cut = body.mesh;
  std::vector<int> parent(cut.rest_positions.size()), twin(parent.size(), -1);
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto is_beyond = [&](int element) {
    double y = 0;
    for (int a = 0; a < 4; ++a)
      y += 0.25 * body.mesh.rest_positions[body.mesh.elements[10 * element + a]].y;
    return y > 0.004;
  };
  std::vector<unsigned char> is_left(parent.size(), 0);
  for (int e = 0; e < cut.ElementCount(); ++e)
    if (!is_beyond(e))
      for (int a = 0; a < 10; ++a) is_left[cut.elements[10 * e + a]] = 1;
  for (int e = 0; e < cut.ElementCount(); ++e)
    for (int a = 0; a < 10 && is_beyond(e); ++a) {
      int& node = cut.elements[10 * e + a];
      if (!is_left[node]) continue;
      if (twin[node] < 0) {
        twin[node] = static_cast<int>(parent.size());
        parent.push_back(node);
        cut.rest_positions.push_back(cut.rest_positions[node]);
      }
      node = twin[node];
    }
  cut.sets.clear();
  const auto model = std::make_shared<const FemModel>(cut, test::MeniscusMaterial());
  FixedAxes fixed;
  BodyState after;
  std::vector<glm::dvec3> load;
  for (const int p : parent) {
    fixed.push_back(body.fixed[p]);
    after.x.push_back(state.x[p]);
    after.v.push_back(state.v[p]);
    load.push_back(body.load[p]);
  }
  solver.Replace(model, fixed, parent);
  int most = 0;
  for (int step = 0; step < 10; ++step) {
    const StepReport report = solver.Step(after, load, {}, {}, kFrame, {});
    EXPECT_TRUE(report.is_finite);
    EXPECT_EQ(report.inverted, 0);
    most = std::max(most, report.iterations / std::max(report.newton, 1));
  }
  solver.BeginRefresh();
  solver.RunRefresh();
  ASSERT_TRUE(solver.TakeRefreshed());
  int fresh = 0;
  for (int step = 0; step < 40; ++step) {
    const StepReport report = solver.Step(after, load, {}, {}, kFrame, {});
    fresh = std::max(fresh, report.iterations / std::max(report.newton, 1));
  }
  BodyState exact{cut.rest_positions, std::vector<glm::dvec3>(parent.size())};
  ImplicitSolver statics(model, fixed);
  ASSERT_TRUE(statics.SolveStatic(exact, load, {}, {}, 1e-10, {}).converged);
  fmt::print(
      "cut in two: {} cg per Newton step with the old factor, {} with the new one; error {:.1e} of "
      "the size\n",
      most, fresh, LargestDistance(after.x, exact.x) / body.Diagonal());
  EXPECT_LE(fresh, 12);
  EXPECT_LE(LargestDistance(after.x, exact.x), 1e-4 * body.Diagonal());
}

TEST(ImplicitSolver, RefusesInputOfTheWrongSize) {
  const SolverBody body = Meniscus(1, {24, 4, 2});
  EXPECT_THROW(ImplicitSolver(body.model, FixedAxes(3, 7)), Error);
  SolverOptions options;
  options.tolerance = -1;
  EXPECT_THROW(ImplicitSolver(body.model, body.fixed, options), Error);
  ImplicitSolver solver(body.model, body.fixed);
  BodyState state{{glm::dvec3(0.0)}, {}};
  EXPECT_FALSE(solver.Step(state, {}, {}, {}, kFrame, {}).is_finite);
  EXPECT_EQ(state.x, body.mesh.rest_positions);  // the last good state
  EXPECT_THROW(solver.Replace(body.model, body.fixed, std::vector<int>{1}), Error);
}

}  // namespace
}  // namespace arthro::simulation
