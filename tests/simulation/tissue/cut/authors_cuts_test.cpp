// Author's cuts before a session: a tear that opens, and fragments that are washed away.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/tissue/contact/embedded_skin.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/simulation/tissue/cut/cut_checks.h"

namespace arthro::simulation {
namespace {

// Tear across the whole block at x = 6.1 mm, from its top at z = 4 mm down.
TearCut TearAcross(double depth) {
  return {{glm::dvec3(6.1, -1, 4) * kMm, glm::dvec3(6.1, 9, 4) * kMm},
          {0, 0, -1},
          depth,
          0.6 * kMm,
          1 * kMm};
}

using PlaceAt = std::function<glm::dvec3(std::span<const glm::dvec3> x, const glm::dvec3& rest)>;

// Opening of the tear: two points on either side of x = 6.1 mm, 1 mm apart at rest and just below
// the top. The block's ends are pulled 2 mm apart; returns the minimum along y.
double GapWhenPulled(const TetMesh& mesh, std::span<const double> share, const PlaceAt& place_at) {
  const auto model = std::make_shared<const FemModel>(mesh, Material{}, share);
  for (const double mass : model->mass()) EXPECT_GT(mass, 0.0);
  const std::vector<glm::dvec3>& rest = mesh.rest_positions;
  FixedAxes fixed(rest.size(), 0);
  std::vector<glm::dvec3> target = rest;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const bool is_left = rest[i].x<1e-9, is_right = rest[i].x> 12 * kMm - 1e-9;
    if (is_left || is_right) fixed[i] = 7, target[i].x += is_left ? -1 * kMm : 1 * kMm;
  }
  ImplicitSolver solver(model, fixed);
  BodyState state{rest, std::vector<glm::dvec3>(rest.size(), glm::dvec3(0.0))};
  const StepReport pulled = solver.SolveStatic(state, {}, {}, target, 1e-8, {});
  EXPECT_TRUE(pulled.converged);
  EXPECT_EQ(pulled.inverted, 0);
  double least = 1.0;
  for (double y = 1; y <= 7; y += 1)
    least = std::min(least, place_at(state.x, glm::dvec3(6.6, y, 3.9) * kMm).x -
                                place_at(state.x, glm::dvec3(5.6, y, 3.9) * kMm).x - 1 * kMm);
  return least;
}

// Meshes the block with elements of size `edge`.
double GapOfCut(std::span<const Cut> cuts, double edge) {
  const auto ticks = [&](double length) {
    return test::EvenTicks(0, length, static_cast<int>(std::lround(length / edge)));
  };
  const TetMesh whole = test::GridMesh(2, {ticks(12 * kMm), ticks(8 * kMm), ticks(4 * kMm)},
                                       [](const glm::dvec3& p) { return p; });
  SolidField field = test::CutBlockField();
  MakeCuts(field, cuts, {});
  MeshCutter cutter(whole, field.spacing());
  const CutMesh& cut = cutter.Rebuild(field);
  test::ExpectSound(cut, whole);
  EXPECT_EQ(cut.piece_count(), 1);
  const ElementFinder finder(whole);
  return GapWhenPulled(cut.mesh, cut.share, [&](auto x, const glm::dvec3& rest) {
    const ElementCopy copy = cutter.FindCopy(finder.Find(rest).element, rest);
    glm::dvec3 place(0.0);
    for (std::size_t i = 0; i < 10; ++i)
      place +=
          copy.weight[i] * x[static_cast<std::size_t>(
                               cut.mesh.elements[static_cast<std::size_t>(copy.element) * 10 + i])];
    return place;
  });
}

// Slot of 2 mm with a square bottom, along faces of a finer mesh.
double GapOfMeshedSlot() {
  const std::vector<double> x{0,         1.5 * kMm, 3 * kMm,   4.4 * kMm,  5.8 * kMm,
                              6.4 * kMm, 7.8 * kMm, 9.2 * kMm, 10.6 * kMm, 12 * kMm};
  TetMesh mesh =
      test::GridMesh(2, {x, test::EvenTicks(0, 8 * kMm, 4), test::EvenTicks(0, 4 * kMm, 4)},
                     [](const glm::dvec3& p) { return p; });
  std::vector<int> kept;
  for (std::size_t e = 0; e < mesh.elements.size(); e += 10) {
    glm::dvec3 middle(0.0);
    for (std::size_t i = 0; i < 4; ++i)
      middle += 0.25 * mesh.rest_positions[static_cast<std::size_t>(mesh.elements[e + i])];
    const bool is_slot = middle.x > 5.8 * kMm && middle.x < 6.4 * kMm && middle.z > 2 * kMm;
    if (!is_slot) kept.insert(kept.end(), &mesh.elements[e], &mesh.elements[e] + 10);
  }
  // Removes the nodes in the slot.
  std::vector<int> number(mesh.rest_positions.size(), -1);
  TetMesh slotted;
  slotted.order = 2;
  for (const int node : kept) {
    int& of = number[static_cast<std::size_t>(node)];
    if (of < 0) {
      of = static_cast<int>(slotted.rest_positions.size());
      slotted.rest_positions.push_back(mesh.rest_positions[static_cast<std::size_t>(node)]);
    }
    slotted.elements.push_back(of);
  }
  const ElementFinder finder(slotted);
  return GapWhenPulled(slotted, {}, [&](auto now, const glm::dvec3& rest) {
    const EmbeddedPoint point = finder.Find(rest);
    glm::dvec3 place(0.0);
    for (std::size_t i = 0; i < 10; ++i)
      place += point.weight[i] *
               now[static_cast<std::size_t>(
                   slotted.elements[static_cast<std::size_t>(point.element) * 10 + i])];
    return place;
  });
}

TEST(AuthorsCuts, TearOpensWhenItsSidesArePulledApart) {
  // Depth 2.3 mm with the round bottom. Elements that are not cut through stay whole, so it opens
  // down to z = 2 mm.
  const std::vector<Cut> tear{TearAcross(2 * kMm)};
  const double whole = GapOfCut({}, kMm), torn = GapOfCut(tear, kMm);
  const double meshed = GapOfMeshedSlot();
  std::printf(
      "pulled by 2 mm, points 1 mm apart separate by %.3f mm whole, %.3f mm torn (%.3f "
      "mm in elements of 2 mm); with the slot in the mesh %.3f mm\n",
      whole / kMm, torn / kMm, GapOfCut(tear, 2 * kMm) / kMm, meshed / kMm);
  EXPECT_NEAR(whole, 2.0 / 12.0 * kMm, 0.05 * kMm) << "uniform strain";
  EXPECT_NEAR(torn, meshed, 0.1 * meshed);
}

TEST(AuthorsCuts, ReportVolumesPerCutAndRemoveLooseFragments) {
  SolidField field = test::CutBlockField();
  const double before = field.Volume();
  // Cuts off the corner at the origin over the whole height; the third cut misses the block.
  const TearCut corner{
      {glm::dvec3(3, -1, 4) * kMm, glm::dvec3(3, 3, 4) * kMm, glm::dvec3(-1, 3, 4) * kMm},
      {0, 0, -1},
      5 * kMm,
      0.6 * kMm,
      1 * kMm};
  const CapsuleCut bite{glm::dvec3(12, 4, 4) * kMm, glm::dvec3(12, 4, 4) * kMm, 1.5 * kMm};
  CapsuleCut beside = bite;
  beside.a.x = beside.b.x = 30 * kMm;
  const std::vector<Ball> held{{glm::dvec3(11, 4, 1) * kMm, 1 * kMm}};
  const MadeCuts made = MakeCuts(field, std::vector<Cut>{corner, bite, beside}, held);
  ASSERT_EQ(made.removed.size(), 3u);
  EXPECT_GT(made.removed[0], 8 * kMm3);
  EXPECT_GT(made.removed[1], 2 * kMm3);
  EXPECT_EQ(made.removed[2], 0.0);
  // Size 2.7 × 2.7 × 4 mm.
  EXPECT_EQ(made.washed.crumbs, 1);
  EXPECT_NEAR(made.washed.edit.removed, 2.7 * 2.7 * 4 * kMm3, 2 * kMm3);
  EXPECT_NEAR(made.removed[0] + made.removed[1] + made.washed.edit.removed, before - field.Volume(),
              1e-12 * before);

  SolidField free_one = test::CutBlockField();
  EXPECT_EQ(MakeCuts(free_one, std::vector<Cut>{corner}, {}).washed.crumbs, 0)
      << "without anchors no part is loose";
}

TEST(AuthorsCuts, CutsThatLeaveNothingAreRefused) {
  SolidField field = test::CutBlockField();
  const CapsuleCut all{glm::dvec3(6, 4, 2) * kMm, glm::dvec3(6, 4, 2) * kMm, 30 * kMm};
  try {
    MakeCuts(field, std::vector<Cut>{all}, {});
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("leave nothing"), std::string::npos) << error.sentence();
  }
}

}  // namespace
}  // namespace arthro::simulation
