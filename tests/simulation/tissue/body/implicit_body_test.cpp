// Implicit tissue under biting and shaving instruments.
#include "simulation/tissue/body/implicit_body.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"
#include "tests/simulation/tissue/field/closed_manifold.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;

// Loose body: a ball of 5 mm about the origin, somewhere in the joint.
ImplicitSpec LooseBody() {
  ImplicitSpec spec;
  spec.name = "loose body";
  spec.surface = test::Sphere({0, 0, 0}, 5 * kMm, 5);
  spec.portal_from_body = {glm::normalize(glm::dquat(0.8, 0.2, -0.4, 0.3)), {0.01, -0.02, 0.05}};
  spec.is_cuttable = true;
  return spec;
}

// Tool with the centre of its bite at `at` and its rod along the body's z.
WorldTool ToolAt(ToolKind kind, const ImplicitSpec& spec, const glm::dvec3& at) {
  WorldTool tool;
  tool.shape = ShapeOf(kind);
  tool.now.is_present = true;
  tool.now.opening = 1;
  const glm::dvec3 middle = 0.5 * (tool.shape.bite.a + tool.shape.bite.b);
  tool.now.portal_from_tool = spec.portal_from_body * Rigid3{{1, 0, 0, 0}, at - middle};
  return tool;
}

// Opens, closes, opens: one bite.
int Bite(ImplicitBody& body, WorldTool tool) {
  int cuts = 0;
  for (const double opening : {1.0, 0.0, 0.0, 1.0}) {
    tool.now.opening = opening;
    cuts += body.Step(tool, kFrame).was_cut;
  }
  return cuts;
}

// Overlap of a ball of radius R with a capsule of radius r and half length l along the ball's z
// axis, at distance d of the axes: by cells of 0.05 mm.
double Overlap(double R, double r, double l, double d) {
  constexpr double h = 0.05e-3;
  double sum = 0;
  for (double z = -l - r + h / 2; z < l + r; z += h)
    for (double y = -r + h / 2; y < r; y += h)
      for (double x = d - r + h / 2; x < d + r; x += h) {
        const double off = std::max(0.0, std::abs(z) - l);
        if (x * x + y * y + z * z < R * R && (x - d) * (x - d) + y * y + off * off < r * r)
          sum += h * h * h;
      }
  return sum;
}

TEST(ImplicitBody, BiteRemovesTissueOncePerClosing) {
  const ImplicitSpec spec = LooseBody();
  ImplicitBody body(spec, {});
  const Capsule bite = ShapeOf(ToolKind::kPunch).bite;
  const WorldTool punch = ToolAt(ToolKind::kPunch, spec, {4.8 * kMm, 0, 0});
  const double whole = body.solid().field.Volume();
  EXPECT_EQ(Bite(body, punch), 1);
  const double expected =
      Overlap(5 * kMm, bite.radius, 0.5 * glm::distance(bite.a, bite.b), 4.8 * kMm);
  std::printf("[ field ] bite of %.3f mm3, by cells %.3f\n", 1e9 * body.cut_report().removed,
              1e9 * expected);
  EXPECT_NEAR(body.cut_report().removed, expected, 0.05 * expected);
  EXPECT_NEAR(whole - body.solid().field.Volume(), body.cut_report().removed, 1e-12 * whole);
  EXPECT_EQ(body.cut_report().cuts, 1);
  EXPECT_EQ(body.cut_report().pieces, 1);
  EXPECT_EQ(Bite(body, punch), 0) << "nothing is left between the jaws";

  ImplicitSpec kept = spec;
  kept.is_cuttable = false;
  ImplicitBody whole_body(kept, {});
  EXPECT_EQ(Bite(whole_body, punch), 0);
}

TEST(ImplicitBody, RunningShaverObeysItsRateAndAStoppedOneRemovesNothing) {
  const ImplicitSpec spec = LooseBody();
  ImplicitBody body(spec, {});
  WorldTool shaver = ToolAt(ToolKind::kShaver, spec, {5.5 * kMm, 0, 0});
  for (int i = 0; i < 60; ++i) EXPECT_FALSE(body.Step(shaver, kFrame).was_cut);
  shaver.now.is_running = true;
  int cuts = 0;
  for (int i = 0; i < 120; ++i) cuts += body.Step(shaver, kFrame).was_cut;
  const double rate = BodyOptions{}.shaver.rate;
  std::printf("[ field ] 2 s of shaving took %.2f mm3 in %d passes\n",
              1e9 * body.cut_report().removed, cuts);
  EXPECT_GT(body.cut_report().removed, 0.0);
  EXPECT_LT(body.cut_report().removed, 2.0 * rate * 1.1);
  EXPECT_GT(cuts, 5);
  EXPECT_EQ(body.cut_report().cuts, cuts);
}

TEST(ImplicitBody, BiteRebuildsOnlyNearbyTrianglesAndMarksThemFresh) {
  const ImplicitSpec spec = LooseBody();
  ImplicitBody body(spec, {});
  const auto whole = body.skin();
  EXPECT_EQ(std::ranges::count(whole->is_fresh, 1), 0);
  EXPECT_EQ(body.positions().size(), body.normals().size());
  const glm::dvec3 at(4.8 * kMm, 0, 0);
  ASSERT_EQ(Bite(body, ToolAt(ToolKind::kPunch, spec, at)), 1);
  const SkinUpdate update = body.skin_update();
  std::printf("[ field ] a bite rebuilt %ld cells in %d of %d bricks\n", update.cells_redone,
              update.bricks_redone, update.bricks_with_skin);
  // Reach of the bite: the capsule and 2.5 spacings around it, in bricks of 8 cells, plus one brick
  // each way.
  const SolidField& field = body.solid().field;
  const Capsule bite = ShapeOf(ToolKind::kPunch).bite;
  double bricks = 1;
  for (const double length : {0.0, 0.0, glm::distance(bite.a, bite.b)})
    bricks *= std::ceil((length + 2 * bite.radius) / field.spacing() / SolidField::kBrick + 1) + 1;
  EXPECT_LE(update.cells_redone, static_cast<long>(bricks) * 512);
  EXPECT_LT(update.bricks_redone, update.bricks_with_skin / 2);

  const auto cut = body.skin();
  ASSERT_NE(cut, whole);
  const test::SurfaceFaults faults = test::FaultsOf(cut->surface);
  EXPECT_EQ(faults.edges + faults.vertices, 0);
  ASSERT_EQ(cut->is_fresh.size(), cut->surface.vertices.size());
  long fresh = 0;
  for (std::size_t v = 0; v < cut->is_fresh.size(); ++v) {
    const glm::dvec3& x = cut->surface.vertices[v];
    const double off = std::hypot(x.x - at.x, x.y) - bite.radius;
    const bool is_on_ball = std::abs(glm::length(x) - 5 * kMm) < 0.02 * kMm;
    if (cut->is_fresh[v] != 0) {
      ++fresh;
      EXPECT_LT(off, 0.5 * field.spacing()) << "a fresh face lies on the bite";
    } else if (off > field.spacing()) {  // the rim is rounded
      EXPECT_TRUE(is_on_ball) << glm::length(x);
    }
    EXPECT_NEAR(glm::length(body.normals()[v]), 1.0, 1e-12);
    if (is_on_ball && off > 3 * field.spacing()) {
      EXPECT_GT(glm::dot(body.normals()[v], glm::normalize(x)), 0.999) << "smooth normals";
    }
  }
  EXPECT_GT(fresh, 50);

  // A miss changes nothing: the picture stays the same.
  EXPECT_EQ(Bite(body, ToolAt(ToolKind::kPunch, spec, {20 * kMm, 0, 0})), 0);
  EXPECT_EQ(body.skin(), cut);
}

// Two balls of 2.2 mm joined by a neck of 0.7 mm: bitten through, one of them is loose.
ImplicitSpec Dumbbell() {
  ImplicitSpec spec = LooseBody();
  const SolidField field = SolidField::FromFunction(
      {glm::dvec3(-6 * kMm, -3 * kMm, -3 * kMm), glm::dvec3(6 * kMm, 3 * kMm, 3 * kMm)}, 0.2 * kMm,
      [](const glm::dvec3& x) {
        const double neck = std::max(std::hypot(x.y, x.z) - 0.7 * kMm, std::abs(x.x) - 3 * kMm);
        return std::min({glm::distance(x, {-3.4 * kMm, 0, 0}) - 2.2 * kMm,
                         glm::distance(x, {3.4 * kMm, 0, 0}) - 2.0 * kMm, neck});
      });
  spec.surface = Polygonise(field);
  return spec;
}

TEST(ImplicitBody, LoosePieceIsWashedAwayAndTheHeldOrLargestStays) {
  for (const bool is_held : {false, true}) {
    ImplicitSpec spec = Dumbbell();
    if (is_held) spec.fixed = {{{3.4 * kMm, 0, 0}, 0.5 * kMm}};  // the smaller one
    ImplicitBody body(spec, {});
    const double whole = body.solid().field.Volume();
    ASSERT_EQ(Bite(body, ToolAt(ToolKind::kPunch, spec, {0, 0, 0})), 1);
    const CutReport& report = body.cut_report();
    EXPECT_EQ(report.debris, 1);
    EXPECT_EQ(report.pieces, 1);
    const double radius = is_held ? 2.2 * kMm : 2.0 * kMm;  // radius of the removed ball
    const double ball = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
    EXPECT_NEAR(report.debris_volume, ball, 0.1 * ball);
    EXPECT_NEAR(whole - body.solid().field.Volume(), report.removed, 1e-9 * whole);
    const double gone = is_held ? -3.4 * kMm : 3.4 * kMm;
    const glm::dvec3 at = spec.portal_from_body * glm::dvec3(gone, 0, 0);
    EXPECT_GT(body.solid().Distance(at), 0.0);
    EXPECT_LT(body.solid().Distance(spec.portal_from_body * glm::dvec3(-gone, 0, 0)), 0.0);
  }
}

TEST(ImplicitBody, ResetRestoresEveryBitInLessThanASecondOfTheProcessor) {
  const ImplicitSpec spec = LooseBody();
  ImplicitBody body(spec, {});
  const auto whole = body.skin();
  const std::vector<float> values(body.solid().field.values().begin(),
                                  body.solid().field.values().end());
  const std::vector<glm::dvec3> normals(body.normals().begin(), body.normals().end());
  for (const double y : {-3.0, 0.0, 3.0})
    ASSERT_EQ(Bite(body, ToolAt(ToolKind::kPunch, spec, {4 * kMm, y * kMm, 0})), 1);
  const std::uint64_t version = body.shape_version();
  const double start_ms = ThreadCpuMs();
  body.Reset();
  const double took_ms = ThreadCpuMs() - start_ms;
  std::printf("[ field ] reset in %.1f ms of the processor\n", took_ms);
  EXPECT_LT(took_ms, 1000);
  EXPECT_GT(body.shape_version(), version) << "the picture must be updated";
  EXPECT_TRUE(std::ranges::equal(body.solid().field.values(), values));
  EXPECT_EQ(body.skin()->surface.vertices, whole->surface.vertices);
  EXPECT_EQ(body.skin()->surface.triangles, whole->surface.triangles);
  EXPECT_EQ(body.skin()->is_fresh, whole->is_fresh);
  EXPECT_TRUE(std::ranges::equal(body.normals(), normals));
  EXPECT_EQ(body.cut_report().cuts, 0);
  EXPECT_EQ(body.cut_report().removed, 0.0);
}

TEST(ImplicitBody, StepWithoutCutAllocatesNothing) {
  const ImplicitSpec spec = LooseBody();
  ImplicitBody body(spec, {});
  WorldTool shaver = ToolAt(ToolKind::kShaver, spec, {30 * kMm, 0, 0});
  shaver.now.is_running = true;
  const long before = test::Allocations();
  for (int i = 0; i < 100; ++i) body.Step(shaver, kFrame);
  EXPECT_EQ(test::Allocations(), before);
}

TEST(ImplicitBody, NonFiniteToolsAndOpenSurfacesAreRefused) {
  ImplicitSpec spec = LooseBody();
  ImplicitBody body(spec, {});
  WorldTool punch = ToolAt(ToolKind::kPunch, spec, {std::nan(""), 0, 0});
  EXPECT_EQ(Bite(body, punch), 0);
  spec.surface.triangles.pop_back();
  try {
    ImplicitBody open(spec, {});
    FAIL() << "an open surface was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadMesh);
    EXPECT_NE(error.sentence().find("loose body"), std::string::npos) << error.sentence();
  }
}

}  // namespace
}  // namespace arthro::simulation
