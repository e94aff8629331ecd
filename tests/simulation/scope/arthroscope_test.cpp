// Hard cases: HAP in resources/doc/hard-cases.md.
#include "simulation/scope/arthroscope.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

constexpr double kRadius = 0.05;

TEST(Arthroscope, AxesAreUnitAndRightHanded) {
  for (double latitude : {-1.2, 0.0, 0.7})
    for (double roll : {-2.0, 0.0, 1.0, 4.0})
      for (double alpha : {0.0, 30.0, 70.0, 90.0}) {
        const ScopeView view =
            ViewFromPose({latitude, 0.4, roll, 0.02}, RadiansFromDegrees(alpha), 0.3);
        EXPECT_NEAR(glm::length(view.view), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(view.view, view.up), 0.0, 1e-12);
        EXPECT_LT(glm::length(glm::cross(view.view, view.up) - view.right), 1e-12);
      }
}

TEST(Arthroscope, NeutralPoseLooksIntoTheJointWithTheViewersAxes) {
  const ScopeView view = ViewFromPose({}, 0.0);
  EXPECT_LT(glm::length(view.view - glm::dvec3(0, 0, 1)), 1e-15);
  EXPECT_LT(glm::length(view.up - glm::dvec3(0, -1, 0)), 1e-15);
  EXPECT_LT(glm::length(view.right - glm::dvec3(1, 0, 0)), 1e-15);
}

TEST(Arthroscope, CentreCirclesTheRodAtBeta) {
  for (double alpha_deg : {0.0, 30.0, 70.0, 90.0})
    for (double depth : {0.0, 0.01, 0.03, 0.0499}) {
      const double alpha = RadiansFromDegrees(alpha_deg);
      for (double roll = 0; roll < 6.3; roll += 0.3) {
        const RodPose pose{0.2, -0.3, roll, depth};
        const glm::dvec3 u = BasisOf(pose).axis;
        const glm::dvec3 p = CentreDirection(pose, alpha, kRadius);
        const double angle = std::atan2(glm::length(glm::cross(u, p)), glm::dot(u, p));
        EXPECT_NEAR(angle, CentreAngle(alpha, depth, kRadius), 1e-9);
      }
    }
}

TEST(Arthroscope, PureInsertionLeavesTheForwardCentre) {
  const RodPose shallow{0.2, -0.3, 0.4, 0.001}, deep{0.2, -0.3, 0.4, 0.049};
  EXPECT_LT(
      glm::length(CentreDirection(shallow, 0.0, kRadius) - CentreDirection(deep, 0.0, kRadius)),
      1e-12);
}

TEST(Arthroscope, HeadRollTurnsThePictureOnly) {
  const RodPose pose{0.1, 0.2, 0.5, 0.02};
  const ScopeView with = ViewFromPose(pose, 0.5, 0.5 + 1.0), without = ViewFromPose(pose, 0.5);
  EXPECT_LT(glm::length(with.view - without.view), 1e-15);
  EXPECT_NEAR(glm::dot(with.up, without.up), std::cos(1.0), 1e-12);
  EXPECT_NEAR(glm::dot(with.up, without.right), std::sin(1.0), 1e-12);
  const ScopeView same = ViewFromPose(pose, 0.5, pose.roll);
  EXPECT_LT(glm::length(same.up - without.up), 1e-15);
}

TEST(Arthroscope, WindowIsEquisolidAndInvertible) {
  const RoundWindow window = WindowOfSize(RadiansFromDegrees(90.0), 512);
  const ScopeView view = ViewFromPose({0.1, 0.2, 0.5, 0.02}, 0.5);
  for (double x : {0.0, 100.25, 255.5, 400.0})
    for (double y : {130.0, 255.5, 333.0}) {
      const auto ray = RayFromPixel(window, view, {x, y});
      if (!ray) continue;
      EXPECT_LT(glm::length(PixelFromRay(window, view, *ray) - glm::dvec2(x, y)), 1e-9);
      const double theta =
          std::atan2(glm::length(glm::cross(*ray, view.view)), glm::dot(*ray, view.view));
      const double r = std::hypot(x - 255.5, y - 255.5);
      EXPECT_NEAR(r, 256.0 * std::sin(theta / 2) / std::sin(RadiansFromDegrees(22.5)), 1e-6);
    }
  EXPECT_FALSE(RayFromPixel(window, view, {0.0, 0.0}));
}

TEST(Arthroscope, DirectionsOutsideTheWindowLandOutsideIt) {
  const RoundWindow window = WindowOfSize(RadiansFromDegrees(90.0), 512);
  const ScopeView view = ViewFromPose({}, 0.0);
  for (const glm::dvec3 away : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0.9), glm::dvec3(0, 1, -1)})
    EXPECT_GT(glm::length(PixelFromRay(window, view, away) - window.centre_px), window.radius_px);
}

// The same case for the picture.
TEST(Arthroscope, HardCase15ViewAndCentreAreFiniteAtEveryDepth) {
  for (double depth : {-0.4, -0.05, -0.01, 0.0, 0.01, 0.05 - 1e-15, 0.05, 0.05 + 1e-15, 0.06, 0.2})
    for (double alpha_deg : {0.0, 30.0, 70.0, 90.0})
      for (double roll : {0.0, 1.0, 3.2}) {
        const RodPose pose{0.2, -0.3, roll, depth};
        const double alpha = RadiansFromDegrees(alpha_deg);
        const glm::dvec3 centre = CentreDirection(pose, alpha, kRadius);
        EXPECT_NEAR(glm::length(centre), 1.0, 1e-12);
        EXPECT_TRUE(std::isfinite(CentreAngle(alpha, depth, kRadius)));
      }
}

TEST(Arthroscope, SphereHitIsFiniteFromOutside) {
  const glm::dvec3 hit = SphereHit({0, 0, 0.08}, {1, 0, 0}, kRadius);
  EXPECT_TRUE(std::isfinite(hit.x + hit.y + hit.z));
}

}  // namespace
}  // namespace arthro::simulation
