// One tissue among tools, step by step: a 20 × 20 × 6 mm slab of T10, fixed at its underside.
#include "simulation/tissue/body/deformable_body.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/simulation/tissue/body/slab_body.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

using test::kFrame;
using test::SlabBody;

WorldTool ProbeAt(const BodySpec& spec, double depth, double x = 0.0) {
  return test::ToolAbove(spec, ToolKind::kProbe, depth, x);
}

TEST(DeformableBody, SleepsUntilTouchedAndAgainAfterwards) {
  const BodySpec spec = SlabBody();
  DeformableBody body(spec, {});
  EXPECT_GT(body.held_nodes(), 100);
  ToolCoupling coupling;
  const auto step = [&](double depth) {
    coupling = {};
    const WorldTool tool = ProbeAt(spec, depth);
    return body.Step({&tool, 1}, nullptr, kFrame, {&coupling, 1});
  };
  EXPECT_TRUE(step(-0.02).is_asleep);
  const auto untouched = body.shape_version();
  for (int i = 0; i < 30; ++i) {
    const BodyReport report = step(1e-3);
    EXPECT_FALSE(report.is_asleep);
    EXPECT_FALSE(report.was_reset);
  }
  EXPECT_GT(body.shape_version(), untouched);
  ASSERT_GT(coupling.count, 0);
  const glm::dvec3 up = spec.portal_from_body.rotation * glm::dvec3(0, 0, 1);
  EXPECT_GT(glm::dot(ForceOf(coupling, coupling.tip).force, up), 0.05) << "N";
  int steps = 0;
  while (!step(-0.02).is_asleep && steps < 600) ++steps;
  EXPECT_LT(steps, 120) << "within two seconds after release";
  double off = 0;
  for (std::size_t i = 0; i < body.state().x.size(); ++i)
    off = std::max(off, glm::distance(body.state().x[i], spec.mesh.rest_positions[i]));
  EXPECT_LT(off, 1e-5) << "distance from the rest shape, m";
}

TEST(DeformableBody, ForceGrowsWithDepthAndTheCouplingPredictsIt) {
  const BodySpec spec = SlabBody();
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  double before = 0;
  for (double depth = 0.25e-3; depth < 2.1e-3; depth += 0.25e-3) {
    // Compares the force that the coupling of the last depth predicts with the force after the
    // step.
    const WorldTool tool = ProbeAt(spec, depth);
    const double predicted =
        glm::length(ForceOf(coupling, tool.now.portal_from_tool.translation).force);
    for (int i = 0; i < 40; ++i) {
      coupling = {};
      coupling.tip = tool.now.portal_from_tool.translation;
      body.Step({&tool, 1}, nullptr, kFrame, {&coupling, 1});
    }
    const double force =
        glm::length(ForceOf(coupling, tool.now.portal_from_tool.translation).force);
    EXPECT_GT(force, before);
    if (before > 0) {
      EXPECT_NEAR(predicted / force, 1.0, 0.02) << "2 % over one frame at 15 mm/s";
      printf("depth %.2f mm: %.4f N, predicted from 0.25 mm before %.4f N (%+.1f %%)\n",
             depth * 1e3, force, predicted, 100 * (predicted / force - 1));
    }
    before = force;
  }
}

TEST(DeformableBody, StepsAllocateNothingAfterWarmUp) {
  const BodySpec spec = SlabBody();
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  const auto step = [&](double depth, double x) {
    const WorldTool tool = ProbeAt(spec, depth, x);
    coupling = {};
    const long before = test::Allocations();
    body.Step({&tool, 1}, nullptr, kFrame, {&coupling, 1});
    return test::Allocations() - before;
  };
  for (int i = 0; i < 20; ++i) step(1e-3, 1e-4 * i);
  long allocations = 0;
  for (int i = 0; i < 20; ++i) allocations += step(1.2e-3, 1e-4 * (20 - i));
  EXPECT_EQ(allocations, 0);
}

TEST(DeformableBody, NonFinitePoseIsIgnored) {
  const BodySpec spec = SlabBody();
  DeformableBody body(spec, {});
  ToolCoupling coupling;
  WorldTool tool = ProbeAt(spec, 1e-3);
  for (int i = 0; i < 10; ++i) body.Step({&tool, 1}, nullptr, kFrame, {&coupling, 1});
  tool.now.portal_from_tool.translation.y = std::nan("");
  for (int i = 0; i < 10; ++i) {
    coupling = {};
    const BodyReport report = body.Step({&tool, 1}, nullptr, kFrame, {&coupling, 1});
    EXPECT_FALSE(report.was_reset);
    EXPECT_EQ(coupling.count, 0);
  }
  for (const glm::dvec3& x : body.state().x) ASSERT_TRUE(std::isfinite(x.x + x.y + x.z));
}

TEST(DeformableBody, BallsWithoutNodesAreRefused) {
  BodySpec spec = SlabBody();
  spec.fixed = {{{1.0, 0.0, 0.0}, 1e-3}};
  try {
    DeformableBody body(spec, {});
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("hold"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace arthro::simulation
