// Mouse and keys to hands (app/steps/practice/hand_motion.h), and rotations as three angles.
#include "app/steps/practice/hand_motion.h"

#include <cmath>

#include <GLFW/glfw3.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/steps/tissue/tissue_pose.h"

namespace arthro::app {
namespace {

using simulation::RodPose;

TEST(HandMotion, ADragMovesTheTipAlongThePicturesOwnAxesWhateverTheRoll) {
  for (const double roll : {0.0, 0.7, 2.0, -1.5}) {
    const RodPose pose{0.2, -0.3, roll, 0.02};
    const auto view = simulation::ViewFromPose(pose, 0.0);
    const RodPose moved = Sum(pose, MotionOfDrag(pose, view, 1.5, 1e-4, 0.0));
    const glm::dvec3 step = simulation::TipInOwnPortal(moved) - simulation::TipInOwnPortal(pose);
    // To the right in the picture, by half the field of view a whole width.
    EXPECT_GT(glm::dot(glm::normalize(step), view.right), 0.9999) << roll;
    EXPECT_NEAR(glm::length(step), 0.02 * 1e-4 * 0.75, 1e-9) << roll;
  }
}

TEST(HandMotion, AHeldKeyMovesItsHandByTheTimeThatPassed) {
  const auto held = [](int key) { return key == GLFW_KEY_R || key == GLFW_KEY_PAGE_UP; };
  EXPECT_NEAR(MotionOfKeys(true, true, 0.5, held).depth, 0.006, 1e-12);
  EXPECT_NEAR(MotionOfKeys(false, true, 0.5, held).depth, 0.006, 1e-12);
  EXPECT_EQ(MotionOfKeys(false, false, 0.5, held).depth, 0.0)
      << "page keys scroll when the picture has no focus";
}

TEST(HandMotion, GAndHTurnTheCameraHeadByTheTimeThatPassed) {
  const auto only = [](int key) { return [key](int held) { return held == key; }; };
  const double right = HeadTurnOfKeys(0.5, only(GLFW_KEY_H));
  EXPECT_GT(right, 0.2);
  EXPECT_EQ(HeadTurnOfKeys(0.5, only(GLFW_KEY_G)), -right);
  EXPECT_EQ(HeadTurnOfKeys(0.5, only(GLFW_KEY_E)), 0.0);
  EXPECT_EQ(MotionOfKeys(false, true, 0.5, only(GLFW_KEY_H)).roll, 0.0) << "not the scope's";
}

TEST(TissuePose, AnglesGiveBackTheRotationTheyCameFrom) {
  double worst = 0;
  for (const double x : {-170.0, -90.0, -10.0, 0.0, 35.0, 179.0})
    for (const double y : {-89.0, -45.0, 0.0, 60.0, 90.0, -90.0})
      for (const double z : {-120.0, 0.0, 15.0, 180.0}) {
        const glm::dquat rotation = QuaternionOf({x, y, z});
        const glm::dquat again = QuaternionOf(DegreesOf(rotation));
        worst = std::max(worst, 1.0 - std::abs(glm::dot(rotation, again)));
      }
  EXPECT_LT(worst, 1e-12);
}

}  // namespace
}  // namespace arthro::app
