#include "simulation/practice/reach/shaft_conflicts.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

using Kind = ShaftConflict::Kind;

// A ball of 5 mm radius, 25 mm deep, that both shafts can pass beside.
LoadedScene BallScene(double x) {
  LoadedScene loaded;
  Tissue& tissue = loaded.scene.tissues.emplace_back();
  tissue.pose.position = {x, 0, 0.025};
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, 5e-3, 4)));
  return loaded;
}

TEST(ShaftConflicts, NameTheTissueThatAShaftPassesThrough) {
  const ShaftObstacles in_scope(BallScene(0)), in_instrument(BallScene(0.03)),
      beside(BallScene(0.015));
  const glm::dvec3 lens(0, 0, 0.04), portal(0.03, 0, 0), tip(0.03, 0, 0.045);
  const auto scope = in_scope.Find(lens, portal, tip);
  ASSERT_EQ(scope.size(), 1u);
  EXPECT_EQ(scope[0].kind, Kind::kScopeInTissue);
  EXPECT_EQ(scope[0].tissue, 0);
  // A ball of 2 mm meets a sphere of 5 mm whose middle is 25 mm deep at 18 mm. The triangles lie up
  // to 2 um inside of the sphere.
  EXPECT_NEAR(scope[0].depth, 0.018, 1e-5);
  const auto instrument = in_instrument.Find(lens, portal, tip);
  ASSERT_EQ(instrument.size(), 1u);
  EXPECT_EQ(instrument[0].kind, Kind::kInstrumentInTissue);
  EXPECT_TRUE(beside.Find(lens, portal, tip).empty());
}

TEST(ShaftConflicts, ATipThatTouchesTissueIsNone) {
  const ShaftObstacles ball(BallScene(0.03));
  EXPECT_TRUE(ball.Find({0, 0, 0.02}, {0.03, 0, 0}, {0.03, 0, 0.0195}).empty())
      << "the end of the instrument lies at the surface of the ball";
}

TEST(ShaftConflicts, TellWhereTheShaftsTouch) {
  const ShaftObstacles none{LoadedScene{}};
  const auto crossed = none.Find({0, 0, 0.04}, {0.03, 0, 0}, {-0.03, 0, 0.04});
  ASSERT_EQ(crossed.size(), 1u);
  EXPECT_EQ(crossed[0].kind, Kind::kShaftsTouch);
  EXPECT_NEAR(crossed[0].depth, 0.02, 1e-12) << "the two axes meet there";
  EXPECT_TRUE(none.Find({0, 0, 0.04}, {0.03, 0.005, 0}, {-0.03, 0.005, 0.04}).empty())
      << "the axes pass each other at 5 mm, the shafts are 4 mm thick";
}

}  // namespace
}  // namespace arthro::simulation
