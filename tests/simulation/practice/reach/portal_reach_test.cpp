#include "simulation/practice/reach/portal_reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/practice/reach/reach_picture.h"
#include "simulation/scene/projection.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

// 100 x 80 degrees of a sphere of 50 mm.
LoadedScene Joint() {
  LoadedScene loaded;
  loaded.panorama = Share(ColourImage(200, 160));
  loaded.scene.backdrop.radius = 0.05;
  loaded.scene.backdrop.projection = {ProjectionType::kEquirectangular, {99.5, 79.5}, 1000, 2};
  loaded.scene.scope.view_angle = 0;
  return loaded;
}

// Relief 0 but for a wall that stands 25 mm high where the longitude is 5 to 15 degrees.
LoadedScene WalledJoint() {
  LoadedScene loaded = Joint();
  DepthMap depth(200, 160);
  for (int y = 0; y < depth.height; ++y)
    for (int x = 110; x < 130; ++x) depth.at(x, y) = 0.025f;
  loaded.depth = Share(depth);
  return loaded;
}

double LongitudeOf(const ReachPlace& place) {
  return DegreesFromRadians(std::atan2(place.x.x, place.x.z));
}

TEST(PortalReach, ReachesTheWholeOfAnEmptySphere) {
  for (const double view_angle_deg : {0.0, 30.0, 70.0, 90.0}) {
    LoadedScene loaded = Joint();
    loaded.scene.scope.view_angle = RadiansFromDegrees(view_angle_deg);
    const PortalReach reach = ReachWith(ScopeReachOf(loaded), loaded, 0.03);
    EXPECT_DOUBLE_EQ(reach.relief.seen, 1.0) << view_angle_deg;
    EXPECT_DOUBLE_EQ(reach.relief.touched, 1.0);
    EXPECT_DOUBLE_EQ(reach.relief.both, 1.0);
  }
}

TEST(PortalReach, GivesTheAngleBetweenTheRodsOfAStraightScope) {
  const LoadedScene loaded = Joint();
  const ScopeReach scope = ScopeReachOf(loaded);
  const PortalReach reach = ReachWith(scope, loaded, 0.03);
  ASSERT_FALSE(scope.places.empty());
  double good = 0, whole = 0;
  for (std::size_t i = 0; i < scope.places.size(); ++i) {
    const glm::dvec3 x = scope.places[i].x;
    const double angle =
        std::acos(glm::dot(glm::normalize(x), glm::normalize(x - glm::dvec3(0.03, 0, 0))));
    EXPECT_NEAR(reach.places[i].angle, angle, 1e-9);
    whole += scope.places[i].weight;
    if (angle >= std::numbers::pi / 4 && angle <= std::numbers::pi * 5 / 12)
      good += scope.places[i].weight;
  }
  EXPECT_NEAR(reach.relief.good, good / whole, 1e-12);
  // Longitude ±50° and latitude ±40° of a sphere; the outermost places are half a step from the
  // rim.
  const double solid_angle = RadiansFromDegrees(100) * 2 * std::sin(RadiansFromDegrees(40));
  EXPECT_NEAR(whole * scope.pixel_step * scope.pixel_step / solid_angle, 1, 0.05);
}

// For a view angle α the rods lie on the cone that the law of cosines gives.
TEST(PortalReach, PutsTheLensWhereItsViewMeetsThePlace) {
  LoadedScene loaded = Joint();
  loaded.scene.scope.view_angle = RadiansFromDegrees(70);
  ReachLimits limits;
  limits.nearest = limits.farthest = 0.02;
  const ScopeReach scope = ScopeReachOf(loaded, limits);
  const double alpha = loaded.scene.scope.view_angle;
  for (const ReachPlace& place : scope.places) {
    ASSERT_FALSE(place.rods.empty());
    for (const glm::dvec3& rod : place.rods) {
      // The lens is where the rod passes the place at that distance.
      const double along = glm::dot(place.x, rod);
      const double aside = glm::length(place.x - along * rod);
      EXPECT_NEAR(aside, 0.02 * std::sin(alpha), 1e-12);
      const glm::dvec3 lens = (along - 0.02 * std::cos(alpha)) * rod;
      EXPECT_NEAR(glm::distance(lens, place.x), 0.02, 1e-12);
    }
  }
}

TEST(PortalReach, InstrumentDoesNotPassAWall) {
  const LoadedScene loaded = WalledJoint();
  const ScopeReach scope = ScopeReachOf(loaded);
  // From +40 mm the wall hides what lies just beyond it, to its left.
  const PortalReach right = ReachWith(scope, loaded, 0.04), left = ReachWith(scope, loaded, -0.04);
  for (std::size_t i = 0; i < scope.places.size(); ++i) {
    const double longitude = LongitudeOf(scope.places[i]);
    // Beside the wall the lens has no room.
    if (longitude < -5 || longitude > 25) {
      EXPECT_TRUE(right.places[i].is_seen) << longitude;
    }
    if (longitude > -5 && longitude < 4.5) {
      EXPECT_FALSE(right.places[i].is_touched) << longitude;
      EXPECT_TRUE(left.places[i].is_touched) << longitude;
    }
    if (longitude > 20) {
      EXPECT_TRUE(right.places[i].is_touched) << longitude;
    }
  }
}

TEST(PortalReach, NothingIsReachedWithRodsThatAreTooShort) {
  LoadedScene loaded = Joint();
  loaded.scene.rig.scope.rod_length = 0.01;
  loaded.scene.rig.instrument.rod_length = 0.03;
  const PortalReach reach = ReachWith(ScopeReachOf(loaded), loaded, 0.01);
  EXPECT_EQ(reach.relief.seen, 0);
  EXPECT_EQ(reach.relief.touched, 0);
  EXPECT_EQ(reach.relief.median_angle, 0);
}

// A ball of 5 mm in the middle: its far side is hidden from both, its near side is not.
TEST(PortalReach, TissueHidesItsFarSide) {
  LoadedScene loaded = Joint();
  loaded.surfaces = {Share(test::Sphere({0, 0, 0}, 5e-3, 3))};
  Tissue ball;
  ball.pose.position = {0, 0, 0.03};
  loaded.scene.tissues = {ball};
  const ScopeReach scope = ScopeReachOf(loaded);
  const PortalReach reach = ReachWith(scope, loaded, 0.02);
  ASSERT_EQ(reach.tissues.size(), 1u);
  for (std::size_t i = 0; i < scope.places.size(); ++i) {
    if (scope.places[i].tissue != 0) continue;
    const glm::dvec3 out = (scope.places[i].x - ball.pose.position) / 5e-3;
    const glm::dvec3 to_portal = glm::normalize(-scope.places[i].x),
                     to_instrument = glm::normalize(glm::dvec3(0.02, 0, 0) - scope.places[i].x);
    // Lines to a place end 1 mm before it, which is 26 degrees of this ball.
    if (glm::dot(out, to_portal) > 0.1) {
      EXPECT_TRUE(reach.places[i].is_seen);
    }
    if (glm::dot(out, to_portal) < -0.6) {
      EXPECT_FALSE(reach.places[i].is_seen);
    }
    if (glm::dot(out, to_instrument) > 0.1) {
      EXPECT_TRUE(reach.places[i].is_touched);
    }
    if (glm::dot(out, to_instrument) < -0.6) {
      EXPECT_FALSE(reach.places[i].is_touched);
    }
  }
  EXPECT_LT(reach.relief.seen, 1.0) << "the ball hides a part of the sphere";
}

TEST(PortalReach, SuggestsTheSideThatReaches) {
  LoadedScene loaded = WalledJoint();
  // The target: a small ball just to the left of the wall.
  loaded.surfaces = {Share(test::Sphere({0, 0, 0}, 2e-3, 2))};
  Tissue ball;
  ball.pose.position = {0, 0, 0.045};
  loaded.scene.tissues = {ball};
  loaded.scene.portals.incision_spacing = 0.03;
  const ScopeReach scope = ScopeReachOf(loaded);
  const double spacing = SuggestedSpacing(scope, loaded, {false, {0}, {}});
  EXPECT_LT(spacing, 0) << "the wall stands on the right";
  const auto share = [&](double b) { return ReachWith(scope, loaded, b).tissues[0]; };
  for (int mm = 10; mm <= 60; mm += 2)
    for (const double b : {-1e-3 * mm, 1e-3 * mm}) EXPECT_LE(share(b).good, share(spacing).good);
}

// A ball just to the left of the wall is touched from the left alone, a place to its right from the
// right alone. A target that is reached from both sides decides nothing between them.
TEST(PortalReach, SuggestedSpacingSuitsEveryTargetTheSame) {
  LoadedScene loaded = WalledJoint();
  loaded.surfaces = {Share(test::Sphere({0, 0, 0}, 2e-3, 2))};
  Tissue ball;
  ball.pose.position = {0, 0, 0.045};
  loaded.scene.tissues = {ball};
  loaded.scene.portals.incision_spacing = 0.03;
  const auto at = [](double longitude_deg) {
    const double a = RadiansFromDegrees(longitude_deg);
    return 0.05 * glm::dvec3(std::sin(a), 0, std::cos(a));
  };
  const ScopeReach scope = ScopeReachOf(loaded, {}, {at(25), at(28), at(31)});
  const auto suggested = [&](std::vector<int> tissues, std::vector<int> points) {
    ReachTargets targets;
    targets.tissues = std::move(tissues);
    targets.points = std::move(points);
    return SuggestedSpacing(scope, loaded, targets);
  };
  EXPECT_LT(suggested({0}, {}), 0);
  EXPECT_GT(suggested({}, {0, 1, 2}), 0) << "the wall hides them from the left";
  EXPECT_GT(suggested({0}, {0, 1, 2}), 0) << "three targets are more than one";
  // The relief's shares are those without the points.
  const PortalReach with = ReachWith(scope, loaded, 0.03),
                    without = ReachWith(ScopeReachOf(loaded), loaded, 0.03);
  EXPECT_EQ(with.relief.both, without.relief.both);
}

TEST(ReachPicture, ColoursWhatWasImaged) {
  LoadedScene loaded = WalledJoint();
  DepthMap depth = *loaded.depth;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < 60; ++x) depth.at(x, y) = std::nanf("");
  loaded.depth = Share(depth);
  ReachLimits limits;
  limits.places = 200 * 160;  // every pixel
  const ScopeReach scope = ScopeReachOf(loaded, limits);
  ASSERT_EQ(scope.pixel_step, 1);
  const PortalReach reach = ReachWith(scope, loaded, 0.04);
  const ColourImage drawn = DrawReach(*loaded.panorama, scope, reach);
  for (int y = 0; y < drawn.height; y += 7)
    for (int x = 0; x < 60; ++x) EXPECT_EQ(drawn.at(x, y)[1], 0) << "not imaged";
  for (std::size_t i = 0; i < scope.places.size(); ++i) {
    const auto pixel = scope.places[i].pixel;
    const auto& rgb = ColourOf(ClassOf(reach.places[i])).rgb;
    const std::uint8_t* is = drawn.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(is[c], rgb[c] * 45 / 100);
  }
}

TEST(PortalReach, OfNothingIsNothing) {
  const LoadedScene empty;
  const ScopeReach scope = ScopeReachOf(empty);
  EXPECT_TRUE(scope.places.empty());
  EXPECT_EQ(ReachWith(scope, empty, 0.03).relief.seen, 0);
  EXPECT_EQ(SuggestedSpacing(scope, empty, {true, {}, {}}), empty.scene.portals.incision_spacing);
}

}  // namespace
}  // namespace arthro::simulation
