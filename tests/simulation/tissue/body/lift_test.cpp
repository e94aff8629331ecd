// Probe's hook under the free edge of a meniscus. It lifts the edge with a surgeon's force. The
// edge stays on the hook or slips off, and never passes through it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/tissue/body/meniscus_body.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;

// The rod stands inside the free edge, in the middle of the crescent (its +x), and points down. The
// hook points outwards, under the edge. The tip's height is that of the hook's underside.
WorldTool HookAt(const BodySpec& spec, double radius, double height) {
  const glm::dvec3 hook(1, 0, 0), rod(0, 0, -1);
  WorldTool tool;
  tool.shape = ShapeOf(ToolKind::kProbe);
  tool.now.is_present = true;
  tool.now.portal_from_tool =
      spec.portal_from_body *
      Rigid3{glm::quat_cast(glm::dmat3(glm::cross(hook, rod), hook, rod)), {radius, 0, height}};
  return tool;
}

class Lift : public testing::Test {
 protected:
  Lift() : spec(test::MeniscusBody()), body(spec, {}) {
    const auto& skin = spec.surface.vertices;
    for (std::size_t i = 0; i < skin.size(); ++i)
      if (std::abs(glm::length(glm::dvec2(skin[i])) - 0.010) < 1e-6 && skin[i].z < 1e-9 &&
          skin[i].x > 0.0098)
        edge.push_back(i);
  }
  void Step(const WorldTool& tool) {
    coupling = {};
    coupling.tip = tool.now.portal_from_tool.translation;
    const BodyReport report = body.Step({&tool, 1}, nullptr, kFrame, {&coupling, 1});
    EXPECT_FALSE(report.was_reset);
    const glm::dvec3 on_tool = ForceOf(coupling, coupling.tip).force;
    force = glm::conjugate(spec.portal_from_body.rotation) * on_tool;
    peak = std::max(peak, glm::length(force));
    deepest = std::max(deepest, DepthIn(tool, on_tool));
  }
  // Moves from one position to another in this number of steps.
  template <class At>
  void Move(int steps, At&& at) {
    for (int i = 1; i <= steps; ++i) Step(at(static_cast<double>(i) / steps));
  }
  double Raised() const {  // m, mean of the edge's middle
    double sum = 0;
    for (const std::size_t i : edge) sum += body.positions()[i].z - spec.surface.vertices[i].z;
    return sum / static_cast<double>(edge.size());
  }
  // Depth of a skin vertex in the tool as the tissue holds it: the hand's tool moved by F/k.
  double DepthIn(const WorldTool& tool, const glm::dvec3& on_tool) const {
    std::array<Capsule, kMaxCapsules> capsules;
    const int count = PosedCapsules(tool.shape, tool.now, capsules);
    const Rigid3 body_from_portal = Inverse(spec.portal_from_body);
    double most = 0;
    for (int c = 0; c < count; ++c) {
      const Capsule& capsule = capsules[static_cast<std::size_t>(c)];
      const glm::dvec3 offset = on_tool / ToolContactOptions{}.stiffness;
      const glm::dvec3 a = body_from_portal * (capsule.a + offset),
                       b = body_from_portal * (capsule.b + offset), way = b - a;
      for (const glm::dvec3& x : body.positions()) {
        const double t = std::clamp(glm::dot(x - a, way) / glm::dot(way, way), 0.0, 1.0);
        most = std::max(most, capsule.radius - glm::distance(x, a + t * way));
      }
    }
    return most;
  }

  BodySpec spec;
  DeformableBody body;
  std::vector<std::size_t> edge;
  ToolCoupling coupling;
  glm::dvec3 force{0.0};         // N on the tool, body frame
  double peak = 0, deepest = 0;  // N, m
};

TEST_F(Lift, HookRaisesAndHoldsTheFreeEdge) {
  ASSERT_GT(edge.size(), 2u);
  Move(30, [&](double s) { return HookAt(spec, 0.0085, -0.004 + 0.0022 * s); });
  EXPECT_LT(std::abs(Raised()), 1e-4) << "no contact yet";
  Move(120, [&](double s) { return HookAt(spec, 0.0085, -0.0018 + 0.005 * s); });
  Move(30, [&](double) { return HookAt(spec, 0.0085, 0.0032); });
  std::printf("hand 5 mm up: edge %.2f mm up, %.2f N on the hook (peak %.2f), skin %.3f mm in it\n",
              1e3 * Raised(), glm::length(force), peak, 1e3 * deepest);
  EXPECT_GT(Raised(), 1e-3);
  EXPECT_LT(force.z, -0.05) << "it pulls the hook down";
  EXPECT_LT(peak, 4.0) << "surgeons pull with 3.9 ± 2.0 N (PMC3023859)";
  EXPECT_LT(deepest, 2e-4) << "the skin does not pass through the hook";
  // At rest it stays where it is.
  const double held = Raised();
  Move(120, [&](double) { return HookAt(spec, 0.0085, 0.0032); });
  EXPECT_NEAR(Raised(), held, 1e-4);
  // Lowers the hook again.
  Move(60, [&](double s) { return HookAt(spec, 0.0085, 0.0032 - 0.0072 * s); });
  Move(60, [&](double) { return HookAt(spec, 0.0085, -0.004); });
  EXPECT_LT(std::abs(Raised()), 1e-4);
}

TEST_F(Lift, HookPulledInwardsSlipsOffAndTheEdgeFallsBack) {
  Move(30, [&](double s) { return HookAt(spec, 0.0085, -0.004 + 0.0022 * s); });
  Move(90, [&](double s) { return HookAt(spec, 0.0085, -0.0018 + 0.004 * s); });
  EXPECT_GT(Raised(), 1e-3);
  Move(120, [&](double s) { return HookAt(spec, 0.0085 - 0.006 * s, 0.0022); });
  Move(60, [&](double) { return HookAt(spec, 0.0025, 0.0022); });
  std::printf("pulled inwards by 6 mm: edge %.3f mm up, %.3f N, skin was %.3f mm in the hook\n",
              1e3 * Raised(), glm::length(force), 1e3 * deepest);
  EXPECT_LT(std::abs(Raised()), 1e-4);
  EXPECT_LT(glm::length(force), 1e-3);
  EXPECT_LT(deepest, 2e-4);
}

// The hook holds the edge far from the hand's position. Without memory over a cut the tool would
// start at its hand and the edge would fall.
TEST_F(Lift, EdgeStaysOnTheHookWhileAnotherToolBites) {
  Move(30, [&](double s) { return HookAt(spec, 0.0085, -0.004 + 0.0022 * s); });
  Move(120, [&](double s) { return HookAt(spec, 0.0085, -0.0018 + 0.005 * s); });
  const glm::dvec3 held = force;
  ASSERT_LT(held.z, -0.05);
  // Punch at 70 degrees along the crescent, from inside.
  const double angle = 70 * std::numbers::pi / 180;
  const glm::dvec3 out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
  std::array<WorldTool, 2> tools{HookAt(spec, 0.0085, 0.0032), {}};
  tools[1].shape = ShapeOf(ToolKind::kPunch);
  tools[1].now.is_present = true;
  tools[1].now.portal_from_tool =
      spec.portal_from_body *
      Rigid3{glm::quat_cast(glm::dmat3(glm::cross(up, out), up, out)), 0.0118 * out + 5e-4 * up};
  for (int i = 0; i < 60; ++i) {
    tools[1].now.opening = i < 10 ? 1.0 : 0.0;
    std::array<ToolCoupling, 2> couplings;
    couplings[0].tip = tools[0].now.portal_from_tool.translation;
    EXPECT_FALSE(body.Step(tools, nullptr, kFrame, couplings).was_reset);
    const glm::dvec3 on_hook = glm::conjugate(spec.portal_from_body.rotation) *
                               ForceOf(couplings[0], couplings[0].tip).force;
    // The bite makes the meniscus slightly softer; half the force means a lost edge.
    EXPECT_LT(on_hook.z, 0.5 * held.z) << "step " << i;
  }
  EXPECT_EQ(body.cut_report().cuts, 1);
  std::printf("lift force %.3f N, %.2f mm3 bitten beside it\n", -held.z,
              1e9 * body.cut_report().removed);
}

}  // namespace
}  // namespace arthro::simulation
