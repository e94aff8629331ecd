// Tools pressed into solved tissue: FEM cases of resources/doc/hard-cases.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/tissue/contact/tool_contact.h"
#include "simulation/tissue/solver/implicit_solver.h"
#include "tests/simulation/tissue/contact/slab.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;
constexpr double kRadius = 0.75e-3;

// Slab of 0.5 MPa, 20 × 20 mm, fixed where `is_held` says, with what is needed to press tools into
// it.
struct Slab {
  template <class IsHeld>
  Slab(double thickness, const test::Cells& cells, IsHeld&& is_held)
      : low(-0.01, -0.01, -thickness),
        mesh(test::SlabMesh(2, cells, low, test::kSlabHigh)),
        finder(mesh),
        skin(EmbedSkin(test::SlabSkin(5e-4, low, test::kSlabHigh), mesh, finder)),
        field(SolidField::FromFunction(
            {low - 2e-3, test::kSlabHigh + 2e-3}, 2.5e-4,
            [this](const glm::dvec3& p) { return test::BoxDistance(p, low, test::kSlabHigh); })),
        contact(skin, mesh, field, 5e5),
        model(std::make_shared<FemModel>(mesh, Material{})),
        positions(skin.point.size()),
        normals(skin.point.size()) {
    for (const glm::dvec3& x : mesh.rest_positions) fixed.push_back(is_held(x) ? 7 : 0);
    solver = std::make_unique<ImplicitSolver>(model, fixed);
    state.x = mesh.rest_positions;
    state.v.assign(state.x.size(), glm::dvec3(0.0));
    load.assign(state.x.size(), glm::dvec3(0.0));
  }
  Slab(const Slab&) = delete;

  // One step with a tool of owner `owner`.
  struct Tool {
    std::vector<Capsule> capsules;
    glm::dvec3 motion{0.0};
    ToolGrip grip;
  };
  StepReport Step(std::span<Tool> tools, ImplicitSolver& with, BodyState& at) {
    contacts.clear();
    for (std::size_t i = 0; i < tools.size(); ++i)
      contact.Find(tools[i].capsules, tools[i].motion, static_cast<int>(i), options, contacts,
                   &tools[i].grip);
    results.assign(contacts.size(), {});
    const StepReport report = with.Step(at, load, contacts, {}, kFrame, results);
    for (std::size_t i = 0; i < tools.size(); ++i)
      UpdateGrip(contacts, results, static_cast<int>(i), options, tools[i].grip);
    return report;
  }
  StepReport Step(std::span<Tool> tools) {
    const StepReport report = Step(tools, *solver, state);
    Refit();
    return report;
  }
  void Refit() {
    DeformSkin(skin, mesh, state.x, positions, normals);
    contact.Refit(positions, normals, state.x);
  }
  glm::dvec3 ForceOn(int owner) const {
    glm::dvec3 force(0.0);
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (contacts[i].owner == owner) force -= results[i].force;
    return force;
  }
  // Remaining depth of the held tool in the present skin.
  double Penetration(const Tool& tool) const {
    std::vector<Capsule> held = tool.capsules;
    for (Capsule& capsule : held) capsule.a += tool.grip.offset, capsule.b += tool.grip.offset;
    std::vector<ContactPoint> found;
    contact.Find(held, {}, 0, options, found);
    double deepest = 0;
    for (const ContactPoint& c : found) {
      glm::dvec3 x(0.0);
      for (int k = 0; k < c.count; ++k) x += c.weight[k] * state.x[c.node[k]];
      const glm::dvec3 way = c.b - c.a;
      const double length2 = glm::dot(way, way);
      const double along =
          length2 > 0 ? std::clamp(glm::dot(x - c.a, way) / length2, 0.0, 1.0) : 0.0;
      deepest = std::max(deepest, c.is_round ? c.radius - glm::distance(x, c.a + along * way)
                                             : -glm::dot(c.normal, x - c.foot));
    }
    return deepest;
  }

  glm::dvec3 low;
  TetMesh mesh;
  ElementFinder finder;
  EmbeddedSkin skin;
  SolidField field;
  SkinContact contact;
  std::shared_ptr<FemModel> model;
  std::unique_ptr<ImplicitSolver> solver;
  FixedAxes fixed;
  BodyState state;
  ToolContactOptions options;
  std::vector<glm::dvec3> positions, normals, load;
  std::vector<ContactPoint> contacts;
  std::vector<ContactResult> results;
};

bool OnTheGround(const glm::dvec3& x) { return x.z < -0.0059; }

// Probe whose hook lies level on the slab, its underside at height z.
Slab::Tool ProbeAt(double z, double x = 0.0003) {
  ToolInput input;
  input.is_present = true;
  input.portal_from_tool = {glm::angleAxis(3.14159265358979, glm::dvec3(1, 0, 0)), {x, 0.002, z}};
  std::array<Capsule, kMaxCapsules> capsules;
  const int count = PosedCapsules(ShapeOf(ToolKind::kProbe), input, capsules);
  return {{capsules.begin(), capsules.begin() + count}, {}, {}};
}

void MoveTo(Slab::Tool& tool, const Slab::Tool& place) {
  tool.motion = place.capsules[0].a - tool.capsules[0].a;
  tool.capsules = place.capsules;
}

class Teleport : public testing::TestWithParam<bool> {};

// FEM-09: a probe that was just above the tissue is 5 mm deep in the next step. Or it was absent
// before (its device returned), so nothing is known of its motion.
TEST_P(Teleport, Fem09JumpOf5MmIsResolvedInFiveFrames) {
  // 12 mm thick: up is the shortest way out.
  Slab slab(0.012, {8, 8, 6}, [](const glm::dvec3& x) { return x.z < -0.0119; });
  const bool was_seen = GetParam();
  std::vector<Slab::Tool> tool{ProbeAt(0.0002)};
  if (was_seen)
    for (int i = 0; i < 3; ++i) slab.Step(tool);
  const Slab::Tool there = ProbeAt(-0.005);
  if (was_seen)
    MoveTo(tool[0], there);
  else
    tool[0].capsules = there.capsules;
  std::array<double, 5> depth{}, force{};
  double peak = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const StepReport report = slab.Step(tool);
    tool[0].motion = glm::dvec3(0.0);
    EXPECT_TRUE(report.is_finite);
    EXPECT_EQ(report.inverted, 0) << frame;
    const double now = glm::length(slab.ForceOn(0));
    peak = std::max(peak, now);
    if (frame < 5) {
      depth[frame] = slab.Penetration(tool[0]);
      force[frame] = now;
    }
  }
  const double settled = glm::length(slab.ForceOn(0));
  std::printf("%s: remaining depth %.3f %.3f %.3f %.3f %.3f mm, force %.2f … %.2f N, peak %.2f N\n",
              was_seen ? "seen before" : "from nowhere", 1e3 * depth[0], 1e3 * depth[1],
              1e3 * depth[2], 1e3 * depth[3], 1e3 * depth[4], force[0], settled, peak);
  EXPECT_LT(depth[4], 2e-4);
  EXPECT_GT(settled, 0.5);
  EXPECT_LE(peak, 2.0 * settled);
  EXPECT_GT(slab.ForceOn(0).z, 0.9 * settled) << "upwards, from where it came";
}

INSTANTIATE_TEST_SUITE_P(SeenBeforeAndFromNowhere, Teleport, testing::Values(true, false));

// FEM-09 all over the mesh: on nodes, between them, along and across its lines.
TEST(Probing, Fem09ProbeThatAppearsInsideIsOutInFiveFrames) {
  constexpr double kSettled = 1.9;  // N, settled force after one second, to 2 % (measured above)
  Slab slab(0.012, {8, 8, 6}, [](const glm::dvec3& x) { return x.z < -0.0119; });
  const BodyState rest = slab.state;
  double deepest = 0, hardest = 0;
  for (int place = 0; place < 15; ++place) {
    slab.state = rest;
    slab.solver = std::make_unique<ImplicitSolver>(slab.model, slab.fixed);
    slab.Refit();
    std::vector<Slab::Tool> tool{ProbeAt(-0.005, -0.0035 + 0.0005 * place)};
    for (int frame = 0; frame < 5; ++frame) {
      EXPECT_TRUE(slab.Step(tool).is_finite);
      hardest = std::max(hardest, glm::length(slab.ForceOn(0)));
    }
    const double depth = slab.Penetration(tool[0]);
    EXPECT_LT(depth, 2e-4) << "place " << place;
    deepest = std::max(deepest, depth);
  }
  std::printf("of 15 places the deepest %.3f mm after five frames, %.2f N at most\n", 1e3 * deepest,
              hardest);
  EXPECT_LE(hardest, 2.0 * kSettled);
}

// FEM-16: no frame is lost, the tissue stays, the next valid pose is felt.
TEST(Probing, Fem16NonFinitePoseLeavesTheTissueUnchanged) {
  Slab slab(0.006, {8, 8, 4}, OnTheGround);
  std::vector<Slab::Tool> tool{ProbeAt(-0.001)};
  for (int i = 0; i < 10; ++i) slab.Step(tool);
  const double before = glm::length(slab.ForceOn(0));
  EXPECT_GT(before, 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), 1e300}) {
    std::vector<Slab::Tool> lost = tool;
    for (Capsule& capsule : lost[0].capsules) capsule.a.x = bad;
    lost[0].motion = glm::dvec3(bad);
    const StepReport report = slab.Step(lost);
    EXPECT_TRUE(report.is_finite);
    for (const glm::dvec3& x : slab.state.x) ASSERT_TRUE(std::isfinite(x.x + x.y + x.z));
  }
  for (int i = 0; i < 30; ++i) slab.Step(tool);
  EXPECT_NEAR(glm::length(slab.ForceOn(0)), before, 0.05 * before);
}

}  // namespace
}  // namespace arthro::simulation
