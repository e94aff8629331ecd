// Simulated tissue under punch and shaver during contact.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/scene/mesh/vertex_normals.h"
#include "simulation/tissue/body/deformable_body.h"
#include "tests/simulation/tissue/body/meniscus_body.h"
#include "tests/simulation/tissue/body/plateau.h"
#include "tests/simulation/tissue/body/slab_body.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

// Punch at the slab's edge x = 10 mm: the tool lies along −x with its jaws around the edge.
WorldTool PunchAt(const BodySpec& spec, double reach, double opening) {
  WorldTool tool;
  tool.shape = ShapeOf(ToolKind::kPunch);
  tool.now.is_present = true;
  // Tool z is the slab's −x.
  const Rigid3 body_from_tool{glm::angleAxis(-0.5 * std::numbers::pi, glm::dvec3(0, 1, 0)),
                              {0.01 - reach, 0.0, -0.003}};
  tool.now.portal_from_tool = spec.portal_from_body * body_from_tool;
  tool.now.opening = opening;
  return tool;
}

bool IsSound(const DeformableBody& body) {
  for (const glm::dvec3& x : body.state().x)
    if (!std::isfinite(x.x + x.y + x.z) || glm::length(x) > 0.1) return false;
  for (const glm::dvec3& n : body.normals())
    if (!std::isfinite(n.x + n.y + n.z)) return false;
  return true;
}

TEST(BodyCut, BiteRemovesTissueBetweenTheJawsAndTheBodyContinues) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  const auto step = [&](const WorldTool& tool) {
    coupling = {};
    coupling.tip = tool.now.portal_from_tool.translation;
    return body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  const auto whole = body.skin();
  step(PunchAt(spec, 2e-3, 1.0));
  EXPECT_EQ(body.cut_report().cuts, 0) << "open jaws remove nothing";
  const BodyReport bite = step(PunchAt(spec, 2e-3, 0.0));
  EXPECT_TRUE(bite.was_cut);
  const CutReport report = body.cut_report();
  EXPECT_EQ(report.cuts, 1);
  EXPECT_GT(report.removed, 1e-9) << "m³";
  EXPECT_LT(report.removed, 60e-9);
  EXPECT_TRUE(step(PunchAt(spec, 2e-3, 0.0)).took_shape);
  EXPECT_NE(body.skin(), whole);
  EXPECT_TRUE(std::ranges::count(body.skin()->is_fresh, 1) > 10) << "the cut face is fresh";
  step(PunchAt(spec, 2e-3, 0.0));
  EXPECT_EQ(body.cut_report().cuts, 1) << "closed jaws bite once";
  for (int i = 0; i < 60; ++i) EXPECT_FALSE(step(PunchAt(spec, -5e-3, 0.0)).was_reset);
  EXPECT_TRUE(IsSound(body));

  body.Reset();
  EXPECT_EQ(body.cut_report().removed, 0.0);
  EXPECT_EQ(body.positions().size(), whole->surface.vertices.size());
}

// A bite at one end leaves the triangles, the places and the normals at rest of the other 17 mm.
TEST(BodyCut, BiteKeepsTheSkinThatItDoesNotTouch) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  const auto whole = body.skin();
  ToolCoupling coupling;
  for (const double opening : {1.0, 0.0}) {
    const WorldTool tool = PunchAt(spec, 2e-3, opening);
    body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  }
  ASSERT_EQ(body.cut_report().cuts, 1);
  const auto far_triangles = [](const BodySkin& skin) {
    std::vector<glm::dvec3> normals(skin.surface.vertices.size());
    ComputeVertexNormals(skin.surface.vertices, skin.surface.triangles, normals);
    std::vector<std::array<glm::dvec3, 6>> far;
    for (const auto& t : skin.surface.triangles) {
      std::array<glm::dvec3, 6> corner;
      bool is_far = true;
      for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = skin.surface.vertices[static_cast<std::size_t>(t[i])];
        corner[i + 3] = normals[static_cast<std::size_t>(t[i])];
        is_far = is_far && corner[i].x < 3e-3;  // the jaws reach to x = 8 mm
      }
      if (is_far) far.push_back(corner);
    }
    return far;
  };
  EXPECT_GT(far_triangles(*whole).size(), 100u);
  EXPECT_TRUE(far_triangles(*body.skin()) == far_triangles(*whole));
}

// A pressed tool lies on the skin, millimetres away from its hand. A bite removes some of the
// tissue that held it. A tool without memory of the rest would start deep inside and be thrown out.
TEST(BodyCut, BiteUnderAPressedToolAddsNoForce) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  WorldTool tool = test::ToolAbove(spec, ToolKind::kPunch, 0.0);
  const auto force_of_step = [&] {
    ToolCoupling coupling;
    coupling.tip = tool.now.portal_from_tool.translation;
    const BodyReport report = body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
    EXPECT_TRUE(report.step.is_finite);
    double push = 0.0;  // P₀
    for (int i = 0; i < coupling.count; ++i) {
      const TissueContact& contact = coupling.contact[static_cast<std::size_t>(i)];
      push += contact.stiffness * std::max(contact.depth, 0.0) / contact.power;
    }
    return push;
  };
  double pressed = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double depth = std::min(i * 1e-4, 3e-3);
    tool = test::ToolAbove(spec, ToolKind::kPunch, depth);
    tool.now.opening = 1.0;
    pressed = force_of_step();
  }
  ASSERT_GT(pressed, 0.3) << "N";
  tool.now.opening = 0.0;
  double most = 0.0;
  for (int i = 0; i < 10; ++i) most = std::max(most, force_of_step());
  ASSERT_EQ(body.cut_report().cuts, 1);
  fmt::print("pressed with {:.3f} N, after the bite {:.3f} N at most\n", pressed, most);
  // The closing jaws move some skin: allows a tenth.
  EXPECT_LT(most, 1.1 * pressed);
}

// A step that cuts makes no shape and no solution; the hand feels what it felt, at its new place.
// The next step makes the shape, and the third solves for the time of all. Before, one step did all
// of it, later two.
TEST(BodyCut, StepThatCutsLeavesShapeAndSolutionToTheNextTwo) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  WorldTool tool;
  const auto step = [&](double depth, double opening) {
    tool = test::ToolAbove(spec, ToolKind::kPunch, depth);
    tool.now.opening = opening;
    coupling = {};
    coupling.tip = tool.now.portal_from_tool.translation;
    return body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  for (int i = 0; i < 30; ++i) step(1e-3, 1.0);
  const ToolCoupling before = coupling;
  ASSERT_EQ(before.count, 1);
  const BodyReport cut = step(1.1e-3, 0.0);
  EXPECT_TRUE(cut.was_cut);
  EXPECT_EQ(cut.step.work, 0);
  EXPECT_EQ(cut.contacts, 1);
  ASSERT_EQ(coupling.count, 1);
  const glm::dvec3 expected = ForceOf(before, coupling.tip).force;
  EXPECT_GT(glm::length(expected), 0.05) << "N";
  EXPECT_LT(glm::length(ForceOf(coupling, coupling.tip).force - expected), 1e-9);
  const auto skin = body.skin();
  const BodyReport shaped = step(1.2e-3, 0.0);
  EXPECT_TRUE(shaped.took_shape);
  EXPECT_FALSE(shaped.was_cut);
  EXPECT_EQ(shaped.step.work, 0);
  EXPECT_NE(body.skin(), skin);
  const glm::dvec3 later = ForceOf(before, coupling.tip).force;
  EXPECT_GT(glm::distance(later, expected), 0.005) << "N";
  EXPECT_LT(glm::length(ForceOf(coupling, coupling.tip).force - later), 1e-9);
  const BodyReport solved = step(1.2e-3, 0.0);
  EXPECT_FALSE(solved.was_cut || solved.took_shape);
  EXPECT_GT(solved.step.newton, 0);
  EXPECT_TRUE(IsSound(body));
}

// Work that runs beside the steps prepares a body for its first cut. A tool that arrives cutting
// waits for it, some steps, instead of making the step wait.
TEST(BodyCut, ToolThatArrivesCuttingWaitsForThePreparation) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  int waits = 0;
  body.SetFinishSideWork([&] { ++waits; });
  ToolCoupling coupling;
  const auto step = [&](double opening) {
    const WorldTool tool = PunchAt(spec, 2e-3, opening);
    coupling = {};
    return body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  step(1.0);
  EXPECT_TRUE(body.WantsSideWork());
  body.BeginSideWork();
  EXPECT_FALSE(step(1.0).was_cut);
  EXPECT_FALSE(step(0.0).was_cut) << "it is being prepared";
  body.RunSideWork();
  body.TakeSideWork();
  EXPECT_FALSE(body.WantsSideWork());
  EXPECT_FALSE(step(1.0).was_cut);
  EXPECT_TRUE(step(0.0).was_cut);
  EXPECT_EQ(body.cut_report().cuts, 1);
}

// The plan of the factor after a cut is the same wherever it is made.
TEST(BodyCut, PlanMadeBesideTheStepsChangesNoBit) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody beside(spec, {}), alone(spec, {});
  const auto step = [&](DeformableBody& body, double opening) {
    const WorldTool tool = PunchAt(spec, 2e-3, opening);
    ToolCoupling coupling;
    return body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  beside.SetFinishSideWork([&] {
    beside.RunSideWork();
    beside.TakeSideWork();
  });
  step(beside, 1.0);
  beside.BeginSideWork();  // the preparation
  beside.RunSideWork();
  beside.TakeSideWork();
  step(alone, 1.0);
  for (const double opening : {1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0}) {
    const bool took_shape = step(beside, opening).took_shape;
    EXPECT_EQ(step(alone, opening).took_shape, took_shape);
    EXPECT_EQ(beside.WantsSideWork(), took_shape);
    if (took_shape) beside.BeginSideWork();
    EXPECT_TRUE(beside.state().x == alone.state().x) << "opening " << opening;
  }
  EXPECT_EQ(beside.cut_report().cuts, 2);
}

// Jaws that close again while the shape of a bite is still to be made bite after its solution.
TEST(BodyCut, BiteThatIsDueTooSoonFollowsTheSolution) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  std::string order;
  for (const double opening : {1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0}) {
    const WorldTool tool = PunchAt(spec, order.size() < 3 ? 2e-3 : 4e-3, opening);
    ToolCoupling coupling;
    const BodyReport report = body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
    order += report.was_cut ? 'c' : report.took_shape ? 's' : '.';
  }
  EXPECT_EQ(order, ".cs.cs..");
  EXPECT_EQ(body.cut_report().cuts, 2);
  EXPECT_TRUE(IsSound(body));
}

// Jaws that open and close at every other step, as no hand can, and no time that passes: each bite
// still gets its shape and its solution.
TEST(BodyCut, JawsThatChatterBiteEveryThirdStepAtMost) {
  for (const double dt : {test::kFrame, 0.0}) {
    BodySpec spec = test::SlabBody();
    spec.is_cuttable = true;
    DeformableBody body(spec, {});
    int shapes = 0;
    for (int i = 0; i < 60; ++i) {
      const WorldTool tool = PunchAt(spec, 1e-3 + 5e-5 * i, i % 2);
      ToolCoupling coupling;
      const BodyReport report = body.Step({&tool, 1}, nullptr, dt, {&coupling, 1});
      EXPECT_FALSE(report.was_reset && dt > 0.0) << i;
      shapes += report.took_shape;
    }
    EXPECT_GT(body.cut_report().cuts, 3);
    EXPECT_LE(body.cut_report().cuts, dt > 0.0 ? 20 : 60);
    EXPECT_GE(shapes, body.cut_report().cuts - 1);
    EXPECT_TRUE(IsSound(body));
  }
}

// Nothing waits for ever where there was no memory to prepare: the cut tries it itself.
TEST(BodyCut, CutPreparesABodyThatCouldNotBePreparedBefore) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  body.SetFinishSideWork([] {});
  ToolCoupling coupling;
  const auto step = [&](double opening) {
    const WorldTool tool = PunchAt(spec, 2e-3, opening);
    coupling = {};
    return body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  step(1.0);
  body.BeginSideWork();
  {
    const test::NoMemory here;
    body.RunSideWork();
  }
  body.TakeSideWork();
  EXPECT_FALSE(step(1.0).was_cut);
  EXPECT_FALSE(body.WantsSideWork());
  EXPECT_TRUE(step(0.0).was_cut);
}

// The other thread works on the old body until it returns it.
TEST(BodyCut, BiteWithoutMemoryRestoresTheTissueAfterARefresh) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  const WorldTool open = PunchAt(spec, 2e-3, 1.0), closed = PunchAt(spec, 2e-3, 0.0);
  const auto step = [&](const WorldTool& punch) {
    coupling = {};
    return body.Step({&punch, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  step(open);
  body.BeginSideWork();
  const glm::dvec3* const held = body.state().x.data();
  {
    const test::NoMemory here;
    EXPECT_TRUE(step(closed).was_reset);
  }
  EXPECT_TRUE(coupling.is_faulty);
  EXPECT_TRUE(body.IsLost());
  EXPECT_TRUE(step(closed).was_reset);
  EXPECT_EQ(body.state().x.data(), held);
  body.RunSideWork();
  body.TakeSideWork();
  {
    const test::NoMemory still;
    EXPECT_TRUE(step(closed).was_reset);
  }
  EXPECT_FALSE(step(closed).was_reset);
  EXPECT_FALSE(body.IsLost());
  EXPECT_FALSE(coupling.is_faulty);
  EXPECT_EQ(body.cut_report().cuts, 0);
  EXPECT_TRUE(IsSound(body));
}

TEST(BodyCut, ShaverRemovesNoFasterThanItsRate) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  BodyOptions options;
  DeformableBody body(spec, options);
  WorldTool shaver = test::ToolAbove(spec, ToolKind::kShaver, 1e-3);
  shaver.now.is_running = true;
  ToolCoupling coupling;
  const int steps = 60;
  for (int i = 0; i < steps; ++i) {
    coupling = {};
    EXPECT_FALSE(body.Step({&shaver, 1}, nullptr, test::kFrame, {&coupling, 1}).was_reset);
  }
  const double allowed = options.shaver.rate * steps * test::kFrame;
  EXPECT_GT(body.cut_report().removed, 0.1e-9);
  EXPECT_LT(body.cut_report().removed, 1.2 * allowed) << "m³, of " << allowed;
  EXPECT_TRUE(IsSound(body));
}

// Jaws opened elsewhere bite only when the hand closes them: not after another instrument in
// between, and not for an opening that is not finite.
TEST(BodyCut, OnlyClosingJawsBite) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  const auto step = [&](const WorldTool& tool) {
    coupling = {};
    return body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
  };
  step(PunchAt(spec, 2e-3, 1.0));
  step(PunchAt(spec, 2e-3, std::nan("")));
  EXPECT_EQ(body.cut_report().cuts, 0) << "NaN does not count as closed";
  step(test::ToolAbove(spec, ToolKind::kProbe, 1e-3));
  step(PunchAt(spec, 2e-3, 0.0));
  EXPECT_EQ(body.cut_report().cuts, 0) << "it returned closed";
  step(PunchAt(spec, 2e-3, 1.0));
  step(PunchAt(spec, 2e-3, 0.0));
  EXPECT_EQ(body.cut_report().cuts, 1);
}

TEST(BodyCut, ProtectedTissueIsNotCut) {
  const BodySpec spec = test::SlabBody();
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  for (double opening : {1.0, 0.0}) {
    const WorldTool punch = PunchAt(spec, 2e-3, opening);
    body.Step({&punch, 1}, nullptr, test::kFrame, {&coupling, 1});
  }
  EXPECT_EQ(body.cut_report().cuts, 0);
}

// FEM-22, with the preconditioner passed on from cut to cut.
TEST(Fem22, CutsDuringContactKeepAValidBody) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  int most = 0, cuts = 0;
  for (int bite = 0; bite < 24; ++bite) {
    const double x = -8e-3 + 0.7e-3 * bite;
    WorldTool punch = test::ToolAbove(spec, ToolKind::kPunch, 2.5e-3, x);
    for (const double opening : {1.0, 1.0, 0.0, 0.0}) {
      punch.now.opening = opening;
      coupling = {};
      const BodyReport report = body.Step({&punch, 1}, nullptr, test::kFrame, {&coupling, 1});
      ASSERT_FALSE(report.was_reset) << bite;
      most = std::max(most, report.step.iterations / std::max(1, report.step.newton));
      cuts += report.was_cut;
      if (body.WantsSideWork()) {
        body.BeginSideWork();
        body.RunSideWork();
        body.TakeSideWork();
      }
    }
    ASSERT_TRUE(IsSound(body)) << bite;
  }
  printf("%d cuts, at most %d iterations\n", cuts, most);
  EXPECT_GT(cuts, 12);
  EXPECT_LE(most, 60);
}

// FEM-22 on an obstacle: nearly removed tissue lies on it too.
TEST(Fem22, ShavingTissueOnBoneNeedsFewIterations) {
  const BodySpec spec = test::MeniscusBody();
  DeformableBody body(spec, {});
  const test::Plateau plateau(spec.portal_from_body);
  WorldTool shaver;
  shaver.shape = ShapeOf(ToolKind::kShaver);
  shaver.now.is_present = shaver.now.is_running = true;
  ToolCoupling coupling;
  int most = 0, cuts = 0;
  for (int i = 0; i < 240; ++i) {
    // Moves to and fro along the thin edge, down through it onto the bone.
    const double angle = 0.3 * std::sin(0.04 * i), height = 1.5e-3 - std::min(i * 2e-5, 2.5e-3);
    const Rigid3 body_from_tool{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)),
                                {0.0115 * std::cos(angle), 0.0115 * std::sin(angle), height}};
    shaver.now.portal_from_tool = spec.portal_from_body * body_from_tool;
    coupling = {};
    const BodyReport report = body.Step({&shaver, 1}, &plateau, test::kFrame, {&coupling, 1});
    ASSERT_FALSE(report.was_reset) << i;
    most = std::max(most, report.step.iterations / std::max(1, report.step.newton));
    cuts += report.was_cut;
    if (body.WantsSideWork()) {
      body.BeginSideWork();
      body.RunSideWork();
      body.TakeSideWork();
    }
  }
  printf("%d cuts, %.1f mm3, at most %d iterations\n", cuts, 1e9 * body.cut_report().removed, most);
  EXPECT_GT(cuts, 30);
  EXPECT_GT(body.cut_report().removed, 5e-9);
  EXPECT_LE(most, 60);
}

}  // namespace
}  // namespace arthro::simulation
