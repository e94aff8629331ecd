#include "simulation/scope/camera_head.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::simulation {
namespace {

// North carried from the direction of the rod to that of the view along the shortest arc
// (Rodrigues).
glm::dvec3 CarriedNorth(const RodPose& pose, const glm::dvec3& view) {
  const RodBasis rod = BasisOf(pose);
  const glm::dvec3 axis = glm::cross(rod.axis, view);
  const double sine = glm::length(axis), cosine = glm::dot(rod.axis, view);
  if (sine < 1e-12) return rod.north;
  const glm::dvec3 k = axis / sine;
  return cosine * rod.north + sine * glm::cross(k, rod.north) +
         (1 - cosine) * glm::dot(k, rod.north) * k;
}

TEST(CameraHead, TurnsWithTheScopeUnlessItIsHeld) {
  for (const double roll : {-4.0, -0.3, 0.0, 2.5}) {
    EXPECT_EQ(HeadRoll({}, roll), roll) << "as in the paper";
    EXPECT_EQ(HeadRoll({.is_upright = true}, roll), 0.0);
    EXPECT_EQ(HeadRoll({.is_upright = true, .turn = 0.2}, roll), 0.2);
    EXPECT_EQ(HeadRoll({.turn = 0.2}, roll), roll + 0.2);
  }
}

// Samples as a device gives them: the hand turns the handle by half a turn either way, and further.
TEST(CameraHead, UprightKeepsThePicturesUpWhileTheRodRollsThroughHalfATurn) {
  const double step = RadiansFromDegrees(0.1);
  for (const double alpha_deg : {0.0, 30.0, 70.0, 90.0}) {
    const double alpha = RadiansFromDegrees(alpha_deg);
    const DeviceRig rig;
    RodPose pose{0.3, -0.4, -3.5, 0.02};
    ScopeView before;
    double worst = 0, worst_turn = 0;
    for (int i = 0; i <= 4000; ++i) {
      const RodPose wanted{0.3, -0.4, -3.5 + i * step, 0.02};
      pose = RodPoseFromHip(HipFromRodPose(wanted, rig), HandleFromRodPose(wanted, rig), rig, pose);
      const ScopeView view = ViewFromPose(pose, alpha, HeadRoll({.is_upright = true}, pose.roll));
      worst = std::max(worst, glm::distance(view.up, CarriedNorth(pose, view.view)));
      if (i > 0) worst_turn = std::max(worst_turn, glm::distance(view.up, before.up));
      before = view;
    }
    std::printf("%2.0f degrees: up is north within %.1e, and turns by at most %.4f of a step\n",
                alpha_deg, worst, worst_turn / step);
    EXPECT_LT(worst, 1e-12);
    // Up moves on a cone about the rod; with α = 0 it is constant.
    EXPECT_LE(worst_turn, 2 * std::sin(alpha / 2) * step + 1e-12);
  }
}

TEST(CameraHead, RefusesOtherText) {
  EXPECT_EQ(CameraHeadFromString("scope"), CameraHead{});
  EXPECT_EQ(CameraHeadFromString("upright"), CameraHead{.is_upright = true});
  EXPECT_THROW(CameraHeadFromString("Upright"), Error);
  EXPECT_THROW(CameraHeadFromString(""), Error);
}

}  // namespace
}  // namespace arthro::simulation
