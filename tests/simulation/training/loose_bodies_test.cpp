#include "simulation/training/observe/loose_bodies.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/training/observe/live_attempt.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kBodyRadius = 2e-3;  // m, of a body

// A bare sphere of 50 mm; below the middle a table of which the top is at y = 8 mm.
LoadedScene JointWithTable() {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection.centre_px = {63.5, 63.5};
  loaded.scene.backdrop.projection.focal_px = 40;
  loaded.panorama = Share(ColourImage(128, 128));
  loaded.scene.tissues.emplace_back();
  loaded.surfaces.push_back(Share(test::Box({-0.02, 0.008, 0.01}, {0.02, 0.012, 0.04})));
  return loaded;
}

class LooseBodiesOnATable : public testing::Test {
 protected:
  LooseBodiesOnATable() {
    now.kind = ToolKind::kGrasper;
    now.instrument.pose.depth = 0.03;
    now.incision_spacing = 0.03;
    now.instrument.opening = 1;
  }
  LooseBodies Of(const glm::dvec3& place) const {
    return {loaded, {{place, kBodyRadius, false, true}}, relief};
  }
  void Ticks(LooseBodies& bodies, int count) {
    for (int i = 0; i < count; ++i) {
      now.t += 0.001;
      bodies.Tick(now, 0.001);
    }
  }
  const LoadedScene loaded = JointWithTable();
  const DepthField relief{loaded.scene.backdrop, 128, 128};
  Snapshot now;
};

TEST_F(LooseBodiesOnATable, JawsThatCloseOnABodyCarryItAndDropIt) {
  const glm::dvec3 start(0.001, 0.006, 0.025);
  LooseBodies bodies = Of(start);
  now.instrument.proxy_in_portal = start + glm::dvec3(0, -kBodyRadius - 1e-3, 0);
  Ticks(bodies, 5);
  EXPECT_EQ(bodies.all()[0].place, start);
  now.instrument.opening = 0.2;
  Ticks(bodies, 1);
  EXPECT_TRUE(bodies.all()[0].is_held);
  now.instrument.proxy_in_portal.y -= 8e-3;
  Ticks(bodies, 1);
  EXPECT_LT(bodies.all()[0].place.y, start.y - 6e-3);
  EXPECT_NEAR(glm::distance(bodies.all()[0].place, now.instrument.proxy_in_portal),
              kBodyRadius + 1e-3, 1e-12);
  now.instrument.opening = 1;
  const double height = bodies.all()[0].place.y;
  Ticks(bodies, 100);
  EXPECT_NEAR(bodies.all()[0].place.y, height + 0.1 * kSinkSpeed, 1e-6);
  Ticks(bodies, 1000);
  EXPECT_TRUE(bodies.all()[0].is_at_rest);
  EXPECT_NEAR(bodies.all()[0].place.y, 0.008 - kBodyRadius, 1e-5);
  const glm::dvec3 rest = bodies.all()[0].place;
  Ticks(bodies, 100);
  EXPECT_EQ(bodies.all()[0].place, rest);
}

TEST_F(LooseBodiesOnATable, JawsThatAreTooFarOrClosedBeforeTakeNothing) {
  const glm::dvec3 start(0.001, 0.006, 0.025);
  LooseBodies bodies = Of(start);
  now.instrument.proxy_in_portal = start + glm::dvec3(0, -kBodyRadius - 1.6e-3, 0);
  Ticks(bodies, 1);
  now.instrument.opening = 0;
  Ticks(bodies, 1);
  EXPECT_FALSE(bodies.all()[0].is_held) << "1.6 mm off";
  now.instrument.proxy_in_portal = start + glm::dvec3(0, -kBodyRadius, 0);
  Ticks(bodies, 10);
  EXPECT_FALSE(bodies.all()[0].is_held) << "closed jaws that come near";
  now.instrument.opening = 1;
  now.kind = ToolKind::kPunch;
  Ticks(bodies, 1);
  now.instrument.opening = 0;
  Ticks(bodies, 1);
  EXPECT_FALSE(bodies.all()[0].is_held) << "a punch is no grasper";
  EXPECT_EQ(bodies.all()[0].place, start);
}

TEST_F(LooseBodiesOnATable, ChangeOfTheInstrumentDropsTheBody) {
  LooseBodies bodies = Of({0.001, 0, 0.025});
  now.instrument.proxy_in_portal = {0.001, -kBodyRadius, 0.025};
  Ticks(bodies, 1);
  now.instrument.opening = 0;
  Ticks(bodies, 1);
  ASSERT_TRUE(bodies.all()[0].is_held);
  now.kind = ToolKind::kProbe;
  Ticks(bodies, 1);
  EXPECT_FALSE(bodies.all()[0].is_held);
}

TEST_F(LooseBodiesOnATable, BodyThatIsLetGoAtItsGoalStaysThere) {
  for (const bool is_at_goal : {true, false}) {
    const Ball goal{{is_at_goal ? 0.001 : 0.02, 0, 0.025}, 8e-3};
    LooseBodies bodies(loaded, {{{0.001, 0, 0.025}, kBodyRadius, false, true}}, relief, {goal});
    now.instrument.proxy_in_portal = {0.001, -kBodyRadius, 0.025};
    now.instrument.opening = 1;
    Ticks(bodies, 1);
    now.instrument.opening = 0;
    Ticks(bodies, 1);
    ASSERT_TRUE(bodies.all()[0].is_held);
    now.instrument.opening = 1;
    Ticks(bodies, 100);
    EXPECT_EQ(bodies.all()[0].is_at_rest, is_at_goal);
    // Elsewhere it sinks, for 0.1 s.
    EXPECT_NEAR(bodies.all()[0].place.y, is_at_goal ? 0.0 : 0.1 * kSinkSpeed, 1e-6);
  }
}

TEST_F(LooseBodiesOnATable, TickAllocatesNothing) {
  LooseBodies bodies = Of({0.001, 0, 0.025});
  now.instrument.proxy_in_portal = {0.001, -kBodyRadius, 0.025};
  const long before = test::Allocations();
  Ticks(bodies, 5);
  now.instrument.opening = 0;
  Ticks(bodies, 5);
  now.instrument.opening = 1;
  Ticks(bodies, 500);
  EXPECT_EQ(test::Allocations(), before);
}

TEST_F(LooseBodiesOnATable, TargetOfAnAttemptMovesWithItsBody) {
  TargetPlace target = TargetInBall({0.001, 0, 0.025}, kBodyRadius);
  target.is_loose = true;
  const ScopeEye eye(loaded);
  LiveAttempt attempt(loaded, {TargetInBall({0, 0, 0.02}, 1e-3), target}, relief, eye);
  now.instrument.proxy_in_portal = {0.001, -kBodyRadius, 0.025};
  const auto ticks = [&](int count) {
    for (int i = 0; i < count; ++i) {
      now.t += 0.001;
      attempt.watch().AfterTick(now, 0.001);
    }
  };
  ticks(20);
  now.instrument.opening = 0;
  ticks(20);
  now.instrument.proxy_in_portal.x += 0.004;
  ticks(21);
  const auto frames = attempt.Update(nullptr);
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_EQ(frames[0].sight.target[1].place, glm::vec3(0.001F, 0, 0.025F));
  EXPECT_GT(frames[5].sight.target[1].place.x, 0.004F);
  EXPECT_EQ(frames[5].sight.target[0].place, glm::vec3(0, 0, 0.02F));
}

}  // namespace
}  // namespace arthro::simulation
