// Body with author's cuts: it starts with them, a reset restores them, and only cuts by tools count
// as removed volume.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "simulation/tissue/body/deformable_body.h"
#include "tests/simulation/tissue/body/slab_body.h"

namespace arthro::simulation {
namespace {

// Tear along y through the middle of the slab's top, 4 mm deep of 6 mm.
BodySpec TornSlab() {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  spec.cuts = {TearCut{{{0, -0.006, 0}, {0, 0.006, 0}}, {0, 0, -1}, 4e-3, 8e-4, 1e-3}};
  return spec;
}

// Volume enclosed by a closed surface.
double VolumeOf(const SurfaceMesh& surface) {
  double six = 0;
  for (const auto& [a, b, c] : surface.triangles)
    six += glm::dot(surface.vertices[static_cast<std::size_t>(a)],
                    glm::cross(surface.vertices[static_cast<std::size_t>(b)],
                               surface.vertices[static_cast<std::size_t>(c)]));
  return six / 6.0;
}

// Mean positions of the fresh vertices on each wall of the tear, well below the top.
std::pair<double, double> Walls(const DeformableBody& body) {
  const BodySkin& skin = *body.skin();
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (std::size_t v = 0; v < skin.is_fresh.size(); ++v) {
    const glm::dvec3& rest = skin.surface.vertices[v];
    if (skin.is_fresh[v] == 0 || rest.z < -2e-3 || rest.z > -0.5e-3 || std::abs(rest.y) > 1e-3)
      continue;
    const int side = rest.x > 0 ? 1 : 0;
    sum[side] += body.positions()[v].x;
    ++count[side];
  }
  EXPECT_GT(count[0], 5);
  EXPECT_GT(count[1], 5);
  return {sum[0] / count[0], sum[1] / count[1]};
}

TEST(AuthorsCuts, BodyStartsTornAndNothingCountsAsRemoved) {
  const BodySpec torn = TornSlab();
  DeformableBody body(torn, {});
  const CutReport& report = body.cut_report();
  EXPECT_EQ(report.removed, 0.0);
  EXPECT_EQ(report.cuts, 0);
  EXPECT_EQ(report.pieces, 1);
  ASSERT_EQ(body.skin()->is_fresh.size(), body.positions().size());
  EXPECT_GT(std::ranges::count(body.skin()->is_fresh, 1), 100) << "its walls are fresh";
  // Slot 12 mm long, 4 mm deep and 0.8 mm wide with round ends and, below, a round bottom.
  // Elsewhere the skin is that of the whole slab.
  const double round = std::numbers::pi * 0.16e-6;
  const double slot = 12e-3 * (4e-3 * 0.8e-3 + 0.5 * round) + 4e-3 * round;
  EXPECT_NEAR(VolumeOf(torn.surface) - VolumeOf(body.skin()->surface), slot, 0.06 * slot);
  // At rest it stays at rest.
  const WorldTool none;
  EXPECT_TRUE(body.Step({&none, 1}, nullptr, test::kFrame, {}).is_asleep);
}

TEST(AuthorsCuts, HookInTheTearPullsTheLipsApart) {
  BodySpec spec = TornSlab();
  std::get<TearCut>(spec.cuts[0]).width = 2e-3;  // wider than the probe
  BodyOptions options;
  options.contact.stiffness = 2e4;  // a stiff hand
  DeformableBody body(spec, options);
  const auto [left, right] = Walls(body);
  EXPECT_NEAR(right - left, 2e-3, 0.1e-3);
  constexpr double kWay = 2e-3;  // distance of the probe's axis, a quarter of it free
  for (int i = 0; i <= 80; ++i) {
    const WorldTool probe = test::ToolAbove(spec, ToolKind::kProbe, 2e-3, std::min(kWay, i * 5e-5));
    ToolCoupling coupling;
    const BodyReport report = body.Step({&probe, 1}, nullptr, test::kFrame, {&coupling, 1});
    ASSERT_FALSE(report.was_reset);
    ASSERT_EQ(report.step.inverted, 0);
  }
  const auto [left_now, right_now] = Walls(body);
  std::printf("pulled by 1.75 mm, one wall moves by %.2f mm and the other by %.2f mm\n",
              1e3 * (right_now - right), 1e3 * (left_now - left));
  EXPECT_GT(right_now - right, 1e-3);
  EXPECT_LT(std::abs(left_now - left), 0.2e-3);
}

TEST(AuthorsCuts, BiteCountsPerRegionAndResetKeepsTheTear) {
  BodySpec spec = TornSlab();
  spec.regions = {{"edge", {{0.01, 0, 0}, 6e-3}}, {"middle", {{0, 0, 0}, 3e-3}}};
  DeformableBody body(spec, {});
  EXPECT_EQ(body.cut_report().by_region, (std::vector<double>{0, 0, 0}));
  const SurfaceMesh torn = body.skin()->surface;
  const auto bite = [&](const glm::dvec3& at) {
    WorldTool tool;
    tool.shape = ShapeOf(ToolKind::kPunch);
    tool.now.is_present = true;
    tool.now.portal_from_tool =
        spec.portal_from_body *
        Rigid3{glm::angleAxis(-0.5 * std::numbers::pi, glm::dvec3(0, 1, 0)), at};
    ToolCoupling coupling;
    for (const double opening : {1.0, 0.0, 0.0, 0.0}) {
      tool.now.opening = opening;
      body.Step({&tool, 1}, nullptr, test::kFrame, {&coupling, 1});
    }
  };
  bite({0.008, 0, -0.003});
  const CutReport one = body.cut_report();
  EXPECT_GT(one.removed, 1e-9);
  EXPECT_NEAR(one.by_region[0], one.removed, 1e-12 * one.removed);
  bite({0.008, 0.008, -0.003});
  const CutReport two = body.cut_report();
  EXPECT_GT(two.by_region[2], 1e-9) << "elsewhere";
  EXPECT_EQ(two.by_region[1], 0.0) << "the author's tear does not count";
  EXPECT_NEAR(std::accumulate(two.by_region.begin(), two.by_region.end(), 0.0), two.removed,
              1e-12 * two.removed);

  const double begin = ThreadCpuMs();
  body.Reset();
  const double reset = ThreadCpuMs() - begin;
  std::printf("reset of a torn slab of %d elements: %.0f ms\n", spec.mesh.ElementCount(), reset);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(reset, 1000.0);  // instrumented code takes several times as long
#endif
  EXPECT_EQ(body.cut_report().removed, 0.0);
  EXPECT_EQ(body.cut_report().by_region, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(body.skin()->surface.vertices, torn.vertices);
  EXPECT_EQ(body.skin()->surface.triangles, torn.triangles);
}

// A fragment that a bite cuts free is removed with it and counts in its region.
TEST(AuthorsCuts, DebrisCountsInItsRegion) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  // Tongue of 4 × 1.8 × 2 mm at the edge x = 10 mm, free except at its root at x = 6 mm.
  spec.cuts = {BoxCut{{{1, 0, 0, 0}, {0.0085, 0, -0.0025}}, {0.0025, 0.0018, 0.0005}},
               TearCut{{{0.0055, -0.0012, 0}, {0.011, -0.0012, 0}}, {0, 0, -1}, 2.5e-3, 6e-4, 1e-3},
               TearCut{{{0.0055, 0.0012, 0}, {0.011, 0.0012, 0}}, {0, 0, -1}, 2.5e-3, 6e-4, 1e-3}};
  spec.regions = {{"tongue", {{0.0095, 0, -0.001}, 2.2e-3}}};
  DeformableBody body(spec, {});
  EXPECT_EQ(body.cut_report().pieces, 1);
  // Opened half a millimetre above it and closed through its root, before anything has moved.
  WorldTool punch = test::ToolAbove(spec, ToolKind::kPunch, 3e-3, 0.0068);
  const Rigid3 there = punch.now.portal_from_tool;
  punch.now.portal_from_tool.translation -= there.rotation * glm::dvec3(0, 0, 3.5e-3);
  punch.now.opening = 1.0;
  ToolCoupling coupling;
  body.Step({&punch, 1}, nullptr, test::kFrame, {&coupling, 1});
  punch.now.portal_from_tool = there;
  punch.now.opening = 0.0;
  body.Step({&punch, 1}, nullptr, test::kFrame, {&coupling, 1});
  const CutReport& report = body.cut_report();
  std::printf("removed %.2f mm3, of which %.2f as %d loose pieces; tongue %.2f\n",
              1e9 * report.removed, 1e9 * report.debris_volume, report.debris,
              1e9 * report.by_region[0]);
  EXPECT_EQ(report.debris, 1);
  EXPECT_GT(report.debris_volume, 1e-9);
  EXPECT_GT(report.by_region[0], 0.5 * report.debris_volume);
  EXPECT_NEAR(report.by_region[0] + report.by_region[1], report.removed, 1e-12 * report.removed);
}

TEST(AuthorsCuts, CutsThatLeaveNothingAreRefusedWithOneSentence) {
  BodySpec spec = test::SlabBody();
  spec.cuts = {CapsuleCut{{0, 0, 0}, {0, 0, 0}, 0.1}};
  EXPECT_THROW(DeformableBody(spec, {}), Error);
  spec.cuts = {TearCut{{{0, 0, 0}}}};
  EXPECT_THROW(DeformableBody(spec, {}), Error);
}

}  // namespace
}  // namespace arthro::simulation
