// FEM-09 at the hand: the instrument is 5 mm deep in deformable tissue from one step to the next.
// The part within the tissue is tested in tissue/body/probing_test.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/tissue/contact/closest_points.h"
#include "tests/simulation/practice/hand.h"
#include "tests/simulation/tissue/contact/slab.h"
#include "tests/simulation/tissue/cut/mesh_boundary.h"

namespace arthro::simulation {
namespace {

constexpr double kFace = 0.036, kThickness = 0.012;  // m; the shortest way out is up
constexpr double kDeep = 0.005;                      // m
constexpr int kFrame = 17;                           // ticks per step of the tissue

// Slab of 0.5 MPa, 20 × 20 × 12 mm, with its top across the axis of the instrument, fixed at its
// underside.
BodySpec Slab() {
  const glm::dvec3 low(-0.01, -0.01, -kThickness);
  BodySpec spec;
  spec.name = "slab";
  spec.mesh = test::SlabMesh(2, {8, 8, 6}, low);
  spec.surface = test::BoundaryOf(test::SlabMesh(1, {40, 40, 24}, low));
  for (const glm::dvec3& x : spec.mesh.rest_positions)
    if (x.z < low.z + 1e-6) spec.fixed.push_back({x, 1e-5});
  // The axis meets the place that the test within the tissue presses.
  spec.portal_from_body = {glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)),
                           {-3e-4, 2e-3, kFace}};
  return spec;
}

// Ways to get there: within one tick of the servo, 5 m/s; within one step of the tissue, 0.3 m/s,
// which a hand can do; or through a device that was silent and reports again there.
enum class Way { kInATick, kInAFrame, kFromNowhere };

struct Course {
  std::vector<glm::dvec3> tip_force, hand_force;  // one per tick, from the first one there
  std::vector<double> depth;  // m, remaining depth in the picture, one per frame
  std::vector<Fault> faults;
  std::vector<glm::dvec3> positions;  // positions of the skin at the end
};

// Returns the depth of the drawn probe in the drawn skin.
double DepthLeft(Hand& hand, const BodySpec& spec) {
  const ToolState& tool = hand.session.snapshot().instrument;
  std::array<Capsule, kMaxCapsules> capsules;
  const ToolInput drawn{true, PortalFromTool({0, 0, 0}, tool.proxy_in_portal, tool.pose.roll), 1,
                        false};
  const int count = PosedCapsules(ShapeOf(ToolKind::kProbe), drawn, capsules);
  double deepest = 0;
  for (const glm::dvec3& x : hand.session.tissues()->bodies[0].positions)
    for (int c = 0; c < count; ++c) {
      const Capsule& part = capsules[static_cast<std::size_t>(c)];
      deepest = std::max(
          deepest, -DistanceToCapsule(spec.portal_from_body * x, part.a, part.b, part.radius));
    }
  return deepest;
}

Course Teleport(Way way, const LimiterOptions& limiter, int frames) {
  const BodySpec spec = Slab();
  Tissue tissue;
  tissue.name = spec.name;
  SessionOptions options;
  options.limiter = limiter;
  Hand hand(SceneOf(spec.surface, tissue), options);
  hand.session.Enliven({spec}, TissuePace::kInline);
  hand.Lead({0, 0, kFace - 5e-3}, 100, 600);  // armed, and the tissue sleeps
  hand.Lead({0, 0, kFace - 2e-4}, 50, 50);    // just above
  EXPECT_EQ(hand.session.snapshot().instrument.tip_force, glm::dvec3(0.0));
  const RodPose there{0, 0, 0, kFace + kDeep};
  const double before = hand.instrument.pose().depth;
  Course course;
  const auto record = [&](const ToolState& tool) {
    course.tip_force.push_back(tool.tip_force);
    course.hand_force.push_back(tool.hand_force);
    course.faults.push_back(tool.fault);
  };
  if (way == Way::kFromNowhere) {
    for (int i = 0; i < 200; ++i) {
      hand.t += kTick;
      hand.session.Tick(hand.scope.Sample(hand.t), {}, kTick);
      hand.session.TickTissues(kTick);
    }
  }
  if (way == Way::kInAFrame)
    for (int i = 1; i < kFrame; ++i) {
      hand.instrument.Set({0, 0, 0, before + (there.depth - before) * i / kFrame});
      record(hand.Tick());
    }
  hand.instrument.Set(there);
  for (int i = 1; i <= frames * kFrame; ++i) {
    record(hand.Tick());
    if (i % kFrame == 0) course.depth.push_back(DepthLeft(hand, spec));
  }
  const BodyReport& report = hand.session.tissues()->bodies[0].report;
  EXPECT_FALSE(report.was_reset);
  EXPECT_EQ(report.step.inverted, 0);
  course.positions = hand.session.tissues()->bodies[0].positions;
  return course;
}

class HardCase9 : public testing::TestWithParam<Way> {};

TEST_P(HardCase9, HardCase9AHandThatIsFiveMillimetresDeepAtOnceIsPushedOutGently) {
  const LimiterOptions limiter;
  const Course course = Teleport(GetParam(), limiter, 30);
  const double settled = glm::length(course.tip_force.back());
  double peak = 0, peak_hand = 0, slew = 0, ramped = 0;
  glm::dvec3 last(0.0);
  int after_fault = limiter.ramp_time / kTick;  // armed
  for (std::size_t i = 0; i < course.hand_force.size(); ++i) {
    const double force = glm::length(course.hand_force[i]);
    after_fault = course.faults[i] == Fault::kNone ? after_fault + 1 : 0;
    peak = std::max(peak, glm::length(course.tip_force[i]));
    peak_hand = std::max(peak_hand, force);
    slew = std::max(slew, force - glm::length(last));
    ramped = std::max(
        ramped, force - limiter.max_force * std::min(1.0, after_fault * kTick / limiter.ramp_time));
    last = course.hand_force[i];
  }
  std::printf(
      "[ teleport ] depth left %.3f %.3f %.3f %.3f %.3f … %.3f mm, tip %.2f N settled, %.2f N at "
      "most, hand %.2f N at most, %.3f N a tick\n",
      1e3 * course.depth[0], 1e3 * course.depth[1], 1e3 * course.depth[2], 1e3 * course.depth[3],
      1e3 * course.depth[4], 1e3 * course.depth.back(), settled, peak, peak_hand, slew);
  // A tool that appears has no known path: the tissue needs eight frames to lead it out instead of
  // three, before the ramp reaches a third of the force.
  EXPECT_LT(GetParam() == Way::kFromNowhere ? course.depth.back() : course.depth[4], 2e-4);
  EXPECT_EQ(course.faults.front(), GetParam() == Way::kInATick ? Fault::kTooFast : Fault::kNone);
  EXPECT_GT(settled, 0.5);
  EXPECT_LT(course.tip_force.back().z, -0.9 * settled) << "up, the way it came from";
  EXPECT_LE(peak, 2.0 * settled);
  EXPECT_LE(peak_hand, 2.0 * settled);
  // The step per tick is at most that of the rise limit plus that of the ramp.
  EXPECT_LE(slew, (limiter.max_rise + peak_hand / limiter.ramp_time) * kTick + 1e-12);
  EXPECT_LE(ramped, 1e-12) << "N above what the ramp lets through";
}

INSTANTIATE_TEST_SUITE_P(Ways, HardCase9,
                         testing::Values(Way::kInATick, Way::kInAFrame, Way::kFromNowhere),
                         [](const auto& way) {
                           return way.param == Way::kInATick    ? "InATick"
                                  : way.param == Way::kInAFrame ? "InAFrame"
                                                                : "FromNowhere";
                         });

// A limiter far stricter than the tissue: the hand gets exactly the allowed force, and the tissue
// is unaffected.
TEST(HardCase9, HardCase9TheLimiterAffectsOnlyTheHand) {
  LimiterOptions strict;
  strict.max_rise = 20.0;
  strict.max_force = 0.8;
  const Course free = Teleport(Way::kInAFrame, {}, 10),
               spared = Teleport(Way::kInAFrame, strict, 10);
  EXPECT_EQ(spared.positions, free.positions);
  EXPECT_EQ(spared.tip_force, free.tip_force);
  ASSERT_GT(glm::length(free.hand_force.back()), strict.max_force) << "or it has nothing to limit";
  double slew = 0, last = 0;
  int rising = 0;
  for (const glm::dvec3& force : spared.hand_force) {
    const double now = glm::length(force);
    slew = std::max(slew, now - last);
    rising += now - last > 0.999 * strict.max_rise * kTick;
    EXPECT_LE(now, strict.max_force + 1e-12);
    last = now;
  }
  EXPECT_NEAR(slew, strict.max_rise * kTick, 1e-12);
  EXPECT_GT(rising, 30) << "ticks of the 40 to the full force at the rate allowed";
  EXPECT_NEAR(last, strict.max_force, 1e-12);
}

}  // namespace
}  // namespace arthro::simulation
