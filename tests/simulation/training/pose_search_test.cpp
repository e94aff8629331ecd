#include "simulation/training/robot/pose_search.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/scope/arthroscope.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr glm::dvec3 kTarget{0.0, 0.0, 0.025};
constexpr double kTargetRadius = 5e-3;  // m

// A bare sphere of 35 mm with a ball before its middle.
LoadedScene SphereWithBall() {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = 0.035;
  loaded.scene.backdrop.projection.centre_px = {99.5, 99.5};
  loaded.scene.backdrop.projection.focal_px = 70;
  loaded.panorama = Share(ColourImage(200, 200));
  loaded.scene.tissues.emplace_back();
  loaded.scene.tissues[0].pose.position = kTarget;
  loaded.surfaces.push_back(Share(test::Sphere({0, 0, 0}, kTargetRadius, 4)));
  return loaded;
}

class PoseSearch : public testing::Test {
 protected:
  std::optional<RodPose> Find(const TargetPlace& target, double view_angle_deg) const {
    return PoseThatSees(loaded, target, RadiansFromDegrees(view_angle_deg), relief, eye);
  }
  const LoadedScene loaded = SphereWithBall();
  const DepthField relief{loaded.scene.backdrop, 200, 200};
  const ScopeEye eye{loaded};
};

TEST_F(PoseSearch, PoseLooksAtTheTargetFromWithinTheLimits) {
  const auto target = TargetOnBearing(loaded, 0.35, 0.4, 2e-3);
  ASSERT_TRUE(target);
  for (const double angle : {0.0, 30.0, 70.0}) {
    const auto pose = Find(*target, angle);
    ASSERT_TRUE(pose) << angle;
    const ScopeView view = ViewFromPose(*pose, RadiansFromDegrees(angle));
    const glm::dvec3 way = target->point - view.tip;
    const double distance = glm::length(way);
    EXPECT_NEAR(glm::dot(view.view, way / distance), 1, 1e-9) << angle;
    EXPECT_GE(distance, 8e-3);
    EXPECT_LE(distance, 25e-3);
    EXPECT_GE(glm::dot(target->normal, -way / distance), 0.5) << "incidence of 60° at most";
  }
}

TEST_F(PoseSearch, NoPoseSeesTheBackOfTheBall) {
  EXPECT_TRUE(Find(*TargetOnTissue(loaded, 0, {0, 0, -kTargetRadius}, 1e-3), 30));
  EXPECT_FALSE(Find(*TargetOnTissue(loaded, 0, {0, 0, kTargetRadius}, 1e-3), 30));
}

TEST_F(PoseSearch, StraightScopeDoesNotSeeWhatTheBallHides) {
  LoadedScene without = loaded;
  without.scene.tissues.clear();
  without.surfaces.clear();
  const auto behind = TargetOnBearing(without, 0, 0, 1e-3);
  ASSERT_TRUE(behind);
  EXPECT_FALSE(Find(*behind, 0));
}

}  // namespace
}  // namespace arthro::simulation
