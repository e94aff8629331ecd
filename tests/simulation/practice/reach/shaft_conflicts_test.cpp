#include "simulation/practice/reach/shaft_conflicts.h"

#include <cmath>

#include <glm/geometric.hpp>
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

// Relief 50 mm away but for a condyle that stands 25 mm high where the longitude is 5 to 15
// degrees.
LoadedScene CondyleScene() {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection = {ProjectionType::kEquirectangular, {99.5, 79.5}, 1000, 2};
  loaded.panorama = Share(ColourImage(200, 160));
  DepthMap depth(200, 160);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 110; x < 130; ++x) depth.at(x, y) = 0.025f;
  loaded.depth = Share(depth);
  return loaded;
}

TEST(ShaftConflicts, NameTheShaftThatPassesThroughTheRelief) {
  const ShaftObstacles condyle(CondyleScene());
  const glm::dvec3 lens(0, 0, 0.02);
  // From the right to a place on the left of the condyle, at the depth of its middle.
  const glm::dvec3 portal(0.04, 0, 0), tip(0.001, 0, 0.045);
  const auto through = condyle.Find(lens, portal, tip);
  ASSERT_EQ(through.size(), 1u);
  EXPECT_EQ(through[0].kind, Kind::kInstrumentInRelief);
  EXPECT_EQ(through[0].tissue, -1);
  // The axis meets the side of the condyle at a longitude of 15 degrees, where x/z = tan 15°: at
  // (0.04 - 0.039 s) = 0.26795 * 0.045 s, s = 0.7834 of 59.5 mm. The map's cells are 0.5 degrees.
  EXPECT_NEAR(through[0].depth, 0.0466, 6e-4);
  EXPECT_NEAR(glm::distance(through[0].place, portal), through[0].depth, 1e-12);
  EXPECT_TRUE(condyle.Find(lens, {-0.04, 0, 0}, tip).empty()) << "from the left the way is free";
}

TEST(ShaftConflicts, ALensBehindTheReliefIsOneAndATipAgainstItIsNone) {
  const ShaftObstacles condyle(CondyleScene());
  const glm::dvec3 portal(-0.03, 0, 0), free(-0.03, 0, 0.02);
  const glm::dvec3 towards(std::sin(0.17), 0, std::cos(0.17));  // way to the condyle, at 10 degrees
  const auto behind = condyle.Find(0.03 * towards, portal, free);
  ASSERT_EQ(behind.size(), 1u);
  EXPECT_EQ(behind[0].kind, Kind::kScopeInRelief);
  EXPECT_NEAR(behind[0].depth, 0.025 + kReliefSlack, 3e-4) << "the pace of the comparison";
  EXPECT_TRUE(condyle.Find(0.0255 * towards, portal, free).empty());
  const glm::dvec3 wall(-0.01, 0, std::sqrt(0.05 * 0.05 - 1e-4));
  const glm::dvec3 way = glm::normalize(wall - portal);
  EXPECT_TRUE(condyle.Find({0, 0, 0.02}, portal, wall + 3e-3 * way).empty()) << "it is pressed";
  EXPECT_EQ(condyle.Find({0, 0, 0.02}, portal, wall + 8e-3 * way).size(), 1u);
}

TEST(ShaftConflicts, APortalInTheWallOfTheJointIsNone) {
  LoadedScene loaded = CondyleScene();
  DepthMap depth(200, 160);
  // The wall beside the portals is 20 mm away, up to a longitude of 40 degrees.
  for (int y = 0; y < depth.height; ++y)
    for (int x = 180; x < 200; ++x) depth.at(x, y) = 0.03f;
  loaded.depth = Share(depth);
  const ShaftObstacles wall(loaded);
  EXPECT_TRUE(wall.Find({0, 0, 0.02}, {0.025, 0, 0.024}, {0, 0, 0.045}).empty())
      << "it comes out of the wall, where it may be";
  const auto inside = wall.Find({0, 0, 0.02}, {0.025, 0, 0.024}, {0.03, 0, 0.029});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0].kind, Kind::kInstrumentInRelief);
  EXPECT_EQ(inside[0].depth, 0);
}

}  // namespace
}  // namespace arthro::simulation
