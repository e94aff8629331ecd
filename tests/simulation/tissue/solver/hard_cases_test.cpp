// Cases FEM-01 to FEM-20 that concern the solver alone: recovery from bad starts, bad elements, bad
// materials, long steps, bad numbers.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "tests/simulation/tissue/solver/solver_bodies.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::LargestDistance;
using test::Meniscus;
using test::SolverBody;

using test::kFrame;

struct Recovery {
  double distance = 0;  // largest node distance from the exact answer, over the bounding diagonal
  int inverted = 0, steps = 0, most_iterations = 0;
  bool stayed_finite = true, was_clamped = false;
};

// Steps the default solver `count` times; `steps` is the number after which the body stayed within
// 1e-4.
Recovery Recover(const SolverBody& body, BodyState state, int count,
                 const std::vector<glm::dvec3>& answer) {
  ImplicitSolver solver(body.model, body.fixed);
  Recovery recovery;
  for (int step = 1; step <= count; ++step) {
    const StepReport report = solver.Step(state, body.load, {}, {}, kFrame, {});
    recovery.stayed_finite = recovery.stayed_finite && report.is_finite;
    recovery.was_clamped = recovery.was_clamped || report.clamped_speed;
    recovery.inverted = report.inverted;
    recovery.most_iterations = std::max(recovery.most_iterations, report.iterations);
    recovery.distance = LargestDistance(state.x, answer) / body.Diagonal();
    if (!(recovery.distance < 1e-4)) recovery.steps = step + 1;
  }
  return recovery;
}

void ExpectRecovered(const Recovery& r, const std::string& start) {
  fmt::print(
      "{:28} within 1e-4 after {:3} steps, final {:.1e}, {} inverted, at most {} cg per step\n",
      start, r.steps, r.distance, r.inverted, r.most_iterations);
  EXPECT_TRUE(r.stayed_finite) << start;
  EXPECT_LT(r.distance, 1e-4) << start;
  EXPECT_EQ(r.inverted, 0) << start;
}

// Moves the free nodes of a body by a rule.
template <class Rule>
BodyState Moved(const SolverBody& body, const Rule& rule) {
  BodyState state = body.Rest();
  for (std::size_t i = 0; i < state.x.size(); ++i)
    if (!body.fixed[i]) state.x[i] = rule(state.x[i]);
  return state;
}

std::vector<std::pair<std::string, SolverBody>> Bodies() {
  return {{"T4 1152", Meniscus(1, {24, 4, 2})}, {"T10 144", Meniscus(2, {12, 2, 1})}};
}

TEST(Fem01, MirroredStartRecoversInTwoSeconds) {
  for (const auto& [name, body] : Bodies())
    ExpectRecovered(
        Recover(body, Moved(body, [](const glm::dvec3& x) { return glm::dvec3(x.x, x.y, -x.z); }),
                120, body.mesh.rest_positions),
        name + " mirrored");
}

TEST(Fem02, FlattenedStartRecoversInTwoSeconds) {
  for (const auto& [name, body] : Bodies())
    ExpectRecovered(
        Recover(body,
                Moved(body, [](const glm::dvec3& x) { return glm::dvec3(x.x, x.y, 1e-6 * x.z); }),
                120, body.mesh.rest_positions),
        name + " flat");
}

TEST(Fem03, AllNodesAtOnePointRecoverInTwoSeconds) {
  for (const auto& [name, body] : Bodies())
    ExpectRecovered(
        Recover(body, Moved(body, [](const glm::dvec3&) { return glm::dvec3(0.01, 0, 0.002); }),
                120, body.mesh.rest_positions),
        name + " one point");
}

TEST(Fem04, RandomStartsRecoverInFiveSeconds) {
  for (const auto& [name, body] : Bodies())
    for (int seed = 1; seed <= 10; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      ExpectRecovered(Recover(body,
                              Moved(body,
                                    [&](const glm::dvec3&) {
                                      return glm::dvec3(random.Uniform(-0.0035, 0.02),
                                                        random.Uniform(-0.02, 0.02),
                                                        random.Uniform(0, 0.006));
                                    }),
                              300, body.mesh.rest_positions),
                      fmt::format("{} random {}", name, seed));
    }
}

// Splits one element in a hundred in four by a node just above one of its faces, so that one of the
// four has volume / edge³ = 1e-6.
TEST(Fem05, SliversChangeAFrameByLessThanOnePercent) {
  const SolverBody clean = Meniscus(1, {24, 4, 2}, -0.05);
  TetMesh mesh = clean.mesh;
  const int elements = mesh.ElementCount();
  double thinnest = 1;
  for (int e = 0; e < elements; e += 100) {
    const std::array<int, 4> node{mesh.elements[4 * e], mesh.elements[4 * e + 1],
                                  mesh.elements[4 * e + 2], mesh.elements[4 * e + 3]};
    const auto& x = mesh.rest_positions;
    const double volume = glm::dot(x[node[1]] - x[node[0]],
                                   glm::cross(x[node[2]] - x[node[0]], x[node[3]] - x[node[0]])) /
                          6;
    double edge = 0;
    for (int a = 0; a < 3; ++a)
      edge = std::max(edge, glm::distance(x[node[a]], x[node[(a + 1) % 3]]));
    const double share = 1e-6 * edge * edge * edge / volume;
    thinnest = std::min(thinnest, share);
    const glm::dvec3 foot = (x[node[0]] + x[node[1]] + x[node[2]]) / 3.0;
    const int added = static_cast<int>(mesh.rest_positions.size());
    mesh.rest_positions.push_back(foot + share * (x[node[3]] - foot));
    for (auto& [name, member] : mesh.sets) member.push_back(0);
    mesh.elements[4 * e + 3] = added;  // the sliver; then one over each other face
    mesh.elements.insert(mesh.elements.end(), {added, node[1], node[2], node[3], node[0], added,
                                               node[2], node[3], node[0], node[1], added, node[3]});
  }
  SolverBody bad = test::MakeBody(mesh, "horns", test::MeniscusMaterial());
  AddSurfaceLoad(bad.mesh, bad.mesh.sets.at("patch"), {0, 0, -0.05}, bad.load);
  ImplicitSolver with(bad.model, bad.fixed), without(clean.model, clean.fixed);
  BodyState a = bad.Rest(), b = clean.Rest();
  int most = 0;
  for (int step = 1; step <= 30; ++step) {
    const StepReport report = with.Step(a, bad.load, {}, {}, kFrame, {});
    without.Step(b, clean.load, {}, {}, kFrame, {});
    most = std::max(most, report.iterations);
    EXPECT_NEAR(bad.MeanZ("patch", a.x) / clean.MeanZ("patch", b.x), 1, 0.01) << step;
    EXPECT_EQ(report.inverted, 0);
  }
  fmt::print(
      "{} slivers of {:.0e} of their element: {:.2e} off the clean mesh, at most {} cg per step\n",
      (elements + 99) / 100, thinnest, bad.MeanZ("patch", a.x) / clean.MeanZ("patch", b.x) - 1,
      most);
}

TEST(Fem06, NearlyIncompressibleStaysAccurateAndConverges) {
  // Continuum answers [benchmarks.md, Tissue references]. Cook's tip hardly depends on nu here, so
  // the value for 0.49 also serves 0.499.
  struct Row {
    double nu, cook, block;
  };
  // Conjugate-gradient iterations per Newton iteration.
  double cook_at_45 = 0, block_at_45 = 0;
  for (const Row& row :
       {Row{0.45, 0, 0}, {0.49, 4.49e-3, -21.59}, {0.499, 4.49e-3, -22.36}, {0.4999, 0, 0}}) {
    const auto material = test::MeniscusMaterial(row.nu);
    SolverBody cook = test::MakeBody(test::CookMesh(2, {16, 8, 2}), "clamp", material);
    AddSurfaceLoad(cook.mesh, cook.mesh.sets.at("end"), {0, 2, 0}, cook.load);
    ImplicitSolver cook_solver(cook.model, cook.fixed);
    BodyState state = cook.Rest();
    const StepReport bent = cook_solver.SolveStatic(state, cook.load, {}, {}, 1e-8, {});
    double tip = 0;
    for (std::size_t i = 0; i < state.x.size(); ++i)
      if (cook.mesh.sets.at("tip")[i])
        tip = std::max(tip, state.x[i].y - cook.mesh.rest_positions[i].y);

    SolverBody block = test::MakeBody(test::BlockMesh(2, {4, 4, 4}), "bottom", material);
    std::vector<glm::dvec3> target = block.mesh.rest_positions;
    for (std::size_t i = 0; i < target.size(); ++i)
      if (block.mesh.sets.at("top")[i]) {
        block.fixed[i] = 7;
        target[i].z -= 1.5e-3;
      }
    ImplicitSolver block_solver(block.model, block.fixed);
    BodyState pressed = block.Rest();
    const StepReport report = block_solver.SolveStatic(pressed, {}, {}, target, 1e-8, {});
    double force = 0;
    for (std::size_t i = 0; i < target.size(); ++i)
      if (block.mesh.sets.at("top")[i]) force += block_solver.reactions()[i].z;
    fmt::print(
        "nu {:.4f}: Cook {:.4f} mm ({:+.1f} %), {} newton {} cg; block {:.2f} N ({:+.1f} %), {} "
        "newton {} cg\n",
        row.nu, 1e3 * tip, row.cook ? 100 * (tip / row.cook - 1) : 0, bent.newton, bent.iterations,
        force, row.block ? 100 * (force / row.block - 1) : 0, report.newton, report.iterations);
    EXPECT_TRUE(bent.converged && report.converged);
    if (row.cook) {
      EXPECT_NEAR(tip / row.cook, 1, row.nu == 0.49 ? 0.03 : 0.10);
      EXPECT_NEAR(force / row.block, 1, 0.10);
    }
    const double cook_each = static_cast<double>(bent.iterations) / bent.newton;
    const double block_each = static_cast<double>(report.iterations) / report.newton;
    if (row.nu == 0.45) {
      cook_at_45 = cook_each;
      block_at_45 = block_each;
    }
    EXPECT_LT(cook_each, 4 * cook_at_45);
    EXPECT_LT(block_each, 4 * block_at_45);
  }
}

// Settles a body in frames and compares it with its exact equilibrium. Like the tissue loop it
// requests a new factor when the old one needs many iterations, and gets it two frames later.
void ExpectSettles(const std::string& name, const SolverBody& body, double tolerance, int most_cg,
                   double dt = kFrame, int steps = 60) {
  constexpr int kMany = 12, kLate = 2;
  ImplicitSolver solver(body.model, body.fixed), exact(body.model, body.fixed);
  BodyState state = body.Rest(), rest = body.Rest();
  EXPECT_TRUE(exact.SolveStatic(rest, body.load, {}, {}, 1e-9, {}).converged) << name;
  int most = 0, refreshes = 0, waiting = 0;
  bool was_refused = false;
  for (int step = 0; step < steps; ++step) {
    const StepReport report = solver.Step(state, body.load, {}, {}, dt, {});
    const int each =
        report.newton > 0 ? (report.iterations + report.newton - 1) / report.newton : 0;
    most = std::max(most, each);
    if (waiting > 0 && --waiting == 0) {
      solver.RunRefresh();
      // A factor of a tangent far from positive definite is refused; the next one is accepted.
      const bool is_taken = solver.TakeRefreshed();
      EXPECT_TRUE(is_taken || !was_refused) << name;
      was_refused = !is_taken;
      refreshes += is_taken;
    } else if (waiting == 0 && each > kMany) {
      solver.BeginRefresh();
      waiting = kLate;
    }
  }
  const double off = body.MeanZ("patch", state.x) / body.MeanZ("patch", rest.x) - 1;
  fmt::print(
      "{:32} error to the static answer {:+.1e}, at most {} cg per Newton iteration, {} new "
      "factors\n",
      name, off, most, refreshes);
  EXPECT_LE(std::abs(off), tolerance) << name;
  EXPECT_LE(most, most_cg) << name;
}

TEST(Fem07, LargeStiffnessRatiosNeedFewIterations) {
  // Soft and stiff hexahedra alternate.
  SolverBody body = Meniscus(1, {24, 4, 2}, -0.005);
  std::vector<double> share(body.mesh.ElementCount(), 1.0);
  for (int e = 0; e < body.mesh.ElementCount(); ++e)
    if (e / 6 % 3 == 1) share[e] = 1e-4;
  body.model = std::make_shared<const FemModel>(body.mesh, test::MeniscusMaterial(), share);
  ExpectSettles("neighbours 1 : 1e4", body, 0.02, 40);
  Material fibred = test::MeniscusMaterial();
  fibred.young_modulus = 2e5;
  fibred.fibre_stiffness = 1.4e8;
  fibred.fibre_axis = FibreAxis::kCircumferentialZ;
  // Uses the reference's two loads; the larger one is applied at once.
  for (const double force : {-0.05, -0.2}) {
    ExpectSettles(fmt::format("fibres 140 in 0.2 MPa, T4, {} N", -force),
                  Meniscus(1, {24, 4, 2}, force, fibred), 0.02, 40);
    ExpectSettles(fmt::format("fibres 140 in 0.2 MPa, T10, {} N", -force),
                  Meniscus(2, {24, 4, 1}, force, fibred), 0.02, 40);
  }
}

TEST(Fem08, LongStepsReachTheSameEquilibrium) {
  for (const double dt : {1.0 / 30, 1.0 / 10, 1.0})
    ExpectSettles(fmt::format("dt {:.3f} s", dt), Meniscus(2, {24, 4, 1}, -0.05), 1e-3, 40, dt, 40);
}

TEST(Fem11, ReleasedBodyNeverGainsEnergyAndRecoversItsShape) {
  for (const int order : {1, 2}) {
    SolverBody body = test::MakeBody(
        test::BeamMesh(order, order == 1 ? test::Cells{20, 2, 2} : test::Cells{10, 1, 1}), "clamp",
        test::MeniscusMaterial(0.3));
    std::vector<glm::dvec3> target = body.mesh.rest_positions;
    for (std::size_t i = 0; i < target.size(); ++i)
      if (body.mesh.sets.at("end")[i]) {
        body.fixed[i] = 7;
        target[i].x += 0.2;  // three times as long
      }
    ImplicitSolver stretcher(body.model, body.fixed);
    BodyState state = body.Rest();
    ASSERT_TRUE(stretcher.SolveStatic(state, {}, {}, target, 1e-8, {}).converged);
    SolverOptions options;
    options.max_speed = 1e3;
    ImplicitSolver solver(body.model, {}, options);
    std::vector<glm::dvec3> force(state.x.size());
    const double start =
        body.model->Assemble(state.x, Law::kStableNeoHookean, Tangent::kNone, force, nullptr)
            .energy;
    double before = start, largest_rise = -start;
    StepReport report;
    for (int step = 0; step < 240; ++step) {
      report = solver.Step(state, {}, {}, {}, kFrame, {});
      double total = report.energy;
      for (std::size_t i = 0; i < state.v.size(); ++i)
        total += 0.5 * body.model->mass()[i] * glm::dot(state.v[i], state.v[i]);
      largest_rise = std::max(largest_rise, total - before);
      before = total;
      EXPECT_TRUE(report.is_finite);
    }
    // Recovers the rest shape up to a rigid motion: compares distances between nodes.
    double off = 0;
    for (std::size_t i = 0; i < state.x.size(); ++i)
      for (std::size_t j = 0; j < i; j += 7)
        off = std::max(
            off, std::abs(glm::distance(state.x[i], state.x[j]) -
                          glm::distance(body.mesh.rest_positions[i], body.mesh.rest_positions[j])));
    fmt::print(
        "order {}: released from {:.3f} J, largest rise {:.1e} of it in a step, shape off by "
        "{:.1e}\n",
        order, start, largest_rise / start, off / body.Diagonal());
    EXPECT_LE(largest_rise, 1e-6 * start);
    EXPECT_LT(off / body.Diagonal(), 1e-4);
  }
}

TEST(Fem16, NonFiniteNumbersAreRefusedAndTheBodyContinues) {
  const SolverBody body = Meniscus(1, {24, 4, 2}, -0.05);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInf = std::numeric_limits<double>::infinity();
  ImplicitSolver solver(body.model, body.fixed), untouched(body.model, body.fixed);
  BodyState state = body.Rest(), other = body.Rest();
  for (int step = 0; step < 4; ++step) {
    solver.Step(state, body.load, {}, {}, kFrame, {});
    untouched.Step(other, body.load, {}, {}, kFrame, {});
  }
  const std::vector<glm::dvec3> good = state.x;
  for (const double bad : {kNan, kInf, -kInf}) {
    std::vector<glm::dvec3> load = body.load, target = body.mesh.rest_positions;
    load[40].y = bad;
    EXPECT_FALSE(solver.Step(state, load, {}, {}, kFrame, {}).is_finite);
    EXPECT_EQ(state.x, good);
    target[3].x = bad;
    EXPECT_FALSE(solver.Step(state, body.load, {}, target, kFrame, {}).is_finite);
    EXPECT_EQ(state.x, good);
    EXPECT_FALSE(solver.Step(state, body.load, {}, {}, bad, {}).is_finite);
    ContactPoint contact = test::PressAt(body, state.x, {0.0137, 0, 0.0025}, {0, 0, -1}, 500, 1e-3);
    contact.foot.z = bad;
    EXPECT_FALSE(solver.Step(state, body.load, {&contact, 1}, {}, kFrame, {}).is_finite);
    EXPECT_EQ(state.x, good);
    state.x[17].z = bad;
    EXPECT_FALSE(solver.Step(state, body.load, {}, {}, kFrame, {}).is_finite);
    EXPECT_EQ(state.x, good);
    state.v[17].z = bad;
    EXPECT_FALSE(solver.Step(state, body.load, {}, {}, kFrame, {}).is_finite);
    EXPECT_EQ(state.x, good);
    state.x[17].z = bad;
    EXPECT_FALSE(solver.SolveStatic(state, body.load, {}, {}, 1e-8, {}).is_finite);
    EXPECT_EQ(state.x, good);
    state = other;
  }
  // The state is as before.
  solver.Step(state, body.load, {}, {}, kFrame, {});
  untouched.Step(other, body.load, {}, {}, kFrame, {});
  EXPECT_EQ(state.x, other.x);
}

TEST(Fem16, HugeForcesGiveFiniteNumbers) {
  const SolverBody body = Meniscus(1, {24, 4, 2});
  for (const double force : {1e3, 1e6, 1e12, 1e100, 1e300}) {
    ImplicitSolver solver(body.model, body.fixed);
    BodyState state = body.Rest();
    std::vector<glm::dvec3> load = body.load;
    load[200] = {force, -force, force};
    for (int step = 0; step < 5; ++step) solver.Step(state, load, {}, {}, kFrame, {});
    for (const glm::dvec3& x : state.x) EXPECT_TRUE(std::isfinite(x.x + x.y + x.z)) << force;
    const Recovery recovery = Recover(body, state, 300, body.mesh.rest_positions);
    ExpectRecovered(recovery, fmt::format("after {:.0e} N", force));
  }
}

TEST(Fem17, TwoTurnsPerSecondCauseNoStrainAndNoExtraCost) {
  const SolverBody body = Meniscus(2, {12, 2, 1});
  ImplicitSolver solver(body.model, body.fixed);
  std::vector<glm::dvec3> force(body.fixed.size());
  // Cost of a stretch of 1 %.
  std::vector<glm::dvec3> stretched = body.mesh.rest_positions;
  for (glm::dvec3& x : stretched) x.x *= 1.01;
  const double unit =
      body.model->Assemble(stretched, Law::kStableNeoHookean, Tangent::kNone, force, nullptr)
          .energy;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 0.5));
  BodyState still = body.Rest(), moving = body.Rest();
  double largest = 0;
  int early = 0, late = 0, frame_cg = 0;
  ImplicitSolver frames(body.model, body.fixed);
  for (int step = 1; step <= 60; ++step) {
    const auto turn =
        glm::dmat3(glm::rotate(glm::dmat4(1.0), 4 * std::numbers::pi * step / 60, axis));
    std::vector<glm::dvec3> target = body.mesh.rest_positions;
    for (glm::dvec3& x : target) x = turn * x;
    const StepReport report = solver.SolveStatic(still, {}, {}, target, 1e-8, {});
    EXPECT_TRUE(report.converged) << step;
    largest = std::max(largest, report.energy);
    (step <= 15  ? early
     : step > 45 ? late
                 : frame_cg) += step <= 15 || step > 45 ? report.iterations : 0;
    const StepReport frame = frames.Step(moving, {}, {}, target, kFrame, {});
    EXPECT_TRUE(frame.is_finite);
    EXPECT_EQ(frame.inverted, 0);
  }
  // Stops the rotation, in frames.
  std::vector<glm::dvec3> target = body.mesh.rest_positions;
  StepReport rest;
  for (int step = 0; step < 120; ++step) rest = frames.Step(moving, {}, {}, target, kFrame, {});
  fmt::print(
      "turned: {:.1e} of the energy of 1 % stretch; {} cg in the first quarter, {} in the last; in "
      "frames, {:.1e} after 2 s\n",
      largest / unit, early, late, rest.energy / unit);
  EXPECT_LT(largest, 1e-6 * unit);
  EXPECT_LT(rest.energy, 1e-6 * unit);
  EXPECT_LE(late, early + early / 5);
}

TEST(Fem18, ExtremeSpeedsAreLimitedAndTheBodyRecovers) {
  for (const auto& [name, body] : Bodies())
    for (const double speed : {1e2, 1e6}) {
      BodyState state = body.Rest();
      for (std::size_t i = 0; i < state.v.size(); ++i)
        if (!body.fixed[i]) state.v[i] = speed * glm::normalize(glm::dvec3(1, -0.5, 2));
      const Recovery recovery = Recover(body, state, 120, body.mesh.rest_positions);
      ExpectRecovered(recovery, fmt::format("{} {:.0e} m/s", name, speed));
      EXPECT_TRUE(recovery.was_clamped);
    }
}

TEST(Fem19, OldFactorServesTenSecondsAndItsRefreshIsNotFelt) {
  const SolverBody body = Meniscus(2, {12, 2, 1});
  ImplicitSolver stale(body.model, body.fixed), swapped(body.model, body.fixed);
  BodyState a = body.Rest(), b = body.Rest();
  ContactPoint contact = test::PressAt(body, a.x, {0.0137, 0, 0.0025}, {0, 0, -1}, 5e3, 0);
  const double surface = contact.foot.z;
  int most = 0;
  double largest_jump = 0, force = 0;
  for (int step = 0; step < 640; ++step) {
    contact.foot.z = surface - 1.5e-3 * (1 - std::cos(0.05 * step));
    if (step == 600) {
      swapped.BeginRefresh();
      swapped.RunRefresh();
      EXPECT_TRUE(swapped.TakeRefreshed());
    }
    ContactResult one, two;
    const StepReport report = stale.Step(a, {}, {&contact, 1}, {}, kFrame, {&one, 1});
    swapped.Step(b, {}, {&contact, 1}, {}, kFrame, {&two, 1});
    most = std::max(
        most, report.newton > 0 ? (report.iterations + report.newton - 1) / report.newton : 0);
    if (step < 600) continue;
    force = std::max(force, std::abs(one.force.z));
    largest_jump = std::max(largest_jump, glm::distance(one.force, two.force));
  }
  fmt::print(
      "600 frames on the rest factor: at most {} cg per Newton iteration; force step at the swap "
      "{:.1e} of "
      "{:.3f} N\n",
      most, largest_jump / force, force);
  EXPECT_LE(most, 40);
  EXPECT_LT(largest_jump, 0.01 * force);
}

TEST(Fem20, CompressedAndZeroLengthFibresStayFinite) {
  for (const bool bear : {true, false}) {
    Material material = test::MeniscusMaterial();
    material.fibre_stiffness = 2e7;
    material.fibre_axis = FibreAxis::kCircumferentialZ;
    material.fibres_bear_compression = bear;
    const SolverBody body = Meniscus(1, {24, 4, 2}, 0, material);
    // Gives all fibres zero length, then half their length; the body recovers from both.
    for (const double share : {0.0, 0.5}) {
      const auto squeeze = [&](const glm::dvec3& x) {
        const double angle = share * std::atan2(x.y, x.x), radius = std::hypot(x.x, x.y);
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), x.z);
      };
      ExpectRecovered(Recover(body, Moved(body, squeeze), 300, body.mesh.rest_positions),
                      fmt::format("fibres at {:.1f}{}", share, bear ? "" : ", tension only"));
    }
  }
}

}  // namespace
}  // namespace arthro::simulation
