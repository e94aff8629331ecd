// Bounds of the change of the picture when a device reports a motion by a tenth of a degree, as
// hand position and handle orientation. VIEW-01.
//
// The view depends only on the direction u of the rod and on t, the mark of the handle projected
// perpendicular to u: north, east and the angles between them cancel. So where rod and handle turn
// as one body, by δ,
//   with no head roll, or a head that was turned on the scope by some angle: view, up and right
//   each
//     turn by δ at most, at the poles and everywhere;
//   with a head that is held (κ = 0): the view by δ at most, everywhere. The picture turns about it
//     by the change of γ besides, which counts from north: roll alone turns its up by 2 sin(α/2) δ
//     at most, any motion by (1 + 1/cos φ) δ. Upright has no meaning where the rod stands along the
//     vertical, so at the poles nothing is promised of it.
// A handle that is not square to its rod, its mark ε away from it, swings the view by δ or
// |cos α − sin α cot ε| δ where the hand moves and the handle does not.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/camera_head.h"
#include "tests/simulation/scope/test_rigs.h"

namespace arthro::simulation {
namespace {

constexpr double kStep = RadiansFromDegrees(0.1);
constexpr double kRounding = 1e-9;  // rad, error of thousands of products of rotations

using test::TiltedRig;

// State of a hand on its device.
struct Hand {
  DeviceRig rig = TiltedRig();
  glm::dvec3 hip{0.0};
  glm::dquat handle{1, 0, 0, 0};
  RodPose pose;

  explicit Hand(const RodPose& start)
      : hip(HipFromRodPose(start, rig)), handle(HandleFromRodPose(start, rig)), pose(start) {}
  // Turns the rod by an angle about an axis of the portal frame, alone or with the handle.
  void Turn(const glm::dvec3& axis_in_portal, double angle, bool with_handle = true) {
    const glm::dquat turn = glm::angleAxis(
        angle, glm::conjugate(rig.portal_from_device) * glm::normalize(axis_in_portal));
    hip = rig.pivot + turn * (hip - rig.pivot);
    if (with_handle) handle = glm::normalize(turn * handle);
    pose = RodPoseFromHip(hip, handle, rig, pose);
  }
};

// Largest turns between successive pictures, rad.
struct Turns {
  double view = 0, up = 0, right = 0;
  void Add(const ScopeView& before, const ScopeView& after) {
    const auto angle = [](const glm::dvec3& a, const glm::dvec3& b) {
      return 2.0 * std::asin(0.5 * glm::distance(a, b));
    };
    view = std::max(view, angle(before.view, after.view));
    up = std::max(up, angle(before.up, after.up));
    right = std::max(right, angle(before.right, after.right));
  }
};

struct Path {
  const char* over;
  RodPose start;
  glm::dvec3 axis;  // portal frame; zero: the axis of the rod
};
const Path kPaths[] = {
    {"both poles", {0.0, 0.0, 0.3, 0.02}, {1, 0, 0}},
    {"both poles, backwards and rolled", {0.2, 1.0, -2.0, 0.02}, {-std::cos(1), 0, std::sin(1)}},
    {"a hair beside the poles", {1.4, 0.0, 0.3, 0.02}, {1, 1e-5, 0}},
    {"a hundredth of a degree beside", {-1.4, 0.0, 3.0, 0.02}, {1, 0, 2e-4}},
    {"longitude 180 degrees", {0.5, 3.0, 0.3, 0.02}, {0, 1, 0}},
    {"longitude -180 degrees", {-0.5, -3.0, 0.3, 0.02}, {0, -1, 0}},
    {"longitude round the pole", {1.57, -3.0, 0.3, 0.02}, {0, 1, 0}},
    {"roll", {0.4, -0.6, 3.0, 0.02}, {0, 0, 0}},
    {"roll at the pole", {0.5 * std::numbers::pi, 0.0, -3.0, 0.02}, {0, 0, 0}},
    {"all at once", {1.3, 2.9, 3.1, 0.02}, {1, -2, 0.5}},
};

Turns TurnsAlong(const Path& path, double alpha, const CameraHead& head, int steps = 3600) {
  Hand hand(path.start);
  const auto look = [&] { return ViewFromPose(hand.pose, alpha, HeadRoll(head, hand.pose.roll)); };
  Turns turns;
  ScopeView before = look();
  for (int i = 0; i < steps; ++i) {
    const bool is_own = path.axis == glm::dvec3(0.0);
    hand.Turn(is_own ? BasisOf(hand.pose).axis : path.axis, kStep);
    const ScopeView view = look();
    turns.Add(before, view);
    before = view;
  }
  return turns;
}

class ViewContinuity : public testing::TestWithParam<double> {
 protected:
  double alpha() const { return RadiansFromDegrees(GetParam()); }
};

TEST_P(ViewContinuity, HardCase21OverPolesDateLineAndRollWrapTheViewTurnsNoFurtherThanTheRod) {
  Turns worst;
  for (const Path& path : kPaths)
    for (const CameraHead& head : {CameraHead{}, CameraHead{.turn = 0.7}}) {
      const Turns turns = TurnsAlong(path, alpha(), head);
      worst.view = std::max(worst.view, turns.view);
      worst.up = std::max(worst.up, turns.up);
      worst.right = std::max(worst.right, turns.right);
      EXPECT_LE(turns.view, kStep + kRounding) << path.over;
      EXPECT_LE(turns.up, kStep + kRounding) << path.over;
      EXPECT_LE(turns.right, kStep + kRounding) << path.over;
    }
  std::printf("%2.0f degrees: a step of 0.1 turns view by %.9f, up %.9f, right %.9f at most\n",
              GetParam(), DegreesFromRadians(worst.view), DegreesFromRadians(worst.up),
              DegreesFromRadians(worst.right));
}

TEST_P(ViewContinuity, AHeldHeadDoesNotChangeTheViewDirection) {
  for (const Path& path : kPaths) {
    const Turns turns = TurnsAlong(path, alpha(), {.is_upright = true});
    EXPECT_LE(turns.view, kStep + kRounding) << path.over;
  }
}

TEST_P(ViewContinuity, WithAHeadThatIsHeldRollTurnsThePictureByTheChordOfTheViewAngle) {
  const Path roll{"roll", {0.4, -0.6, 3.0, 0.02}, {0, 0, 0}};
  const Turns turns = TurnsAlong(roll, alpha(), {.is_upright = true});
  const double most = 2.0 * std::sin(0.5 * alpha()) * kStep;
  EXPECT_LE(turns.up, most + kRounding);
  EXPECT_LE(turns.right, most + kRounding);
  // The bound must be nearly reached, or it would prove little.
  EXPECT_GE(turns.up, 0.999 * most - kRounding);
}

TEST_P(ViewContinuity, WithAHeadThatIsHeldASwingBelow80DegreesKeepsItsBound) {
  const double top = RadiansFromDegrees(80.0);
  for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 2, 0.3)})
    for (const double latitude : {-1.2, 0.0, 1.2}) {
      Hand hand({latitude, 0.3, 0.8, 0.02});
      ScopeView before = ViewFromPose(hand.pose, alpha(), 0.0);
      int compared = 0;
      double worst = 0;
      for (int i = 0; i < 3600; ++i) {
        const double from = std::abs(hand.pose.latitude);
        hand.Turn(axis, kStep);
        const ScopeView view = ViewFromPose(hand.pose, alpha(), 0.0);
        const double highest = std::max(from, std::abs(hand.pose.latitude));
        if (highest < top) {
          Turns turns;
          turns.Add(before, view);
          const double most = (1.0 + 1.0 / std::cos(highest)) * kStep;
          worst = std::max({worst, turns.up / most, turns.right / most});
          ++compared;
        }
        before = view;
      }
      EXPECT_GT(compared, 1000);
      EXPECT_LE(worst, 1.0);
    }
}

TEST_P(ViewContinuity, AHandleThatStaysWhileTheHandMovesTurnsTheViewWithinItsBound) {
  // Turns about the mark of the handle, and across it: rod and mark come within 30 degrees of each
  // other.
  for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 1)}) {
    Hand hand({0.0, 0.0, 0.0, 0.02});
    const glm::dvec3 mark =
        hand.rig.portal_from_device * (hand.handle * glm::dvec3(0.0, -1.0, 0.0));
    ScopeView before = ViewFromPose(hand.pose, alpha());
    for (int i = 0; i < 3600; ++i) {
      const double from = glm::dot(mark, BasisOf(hand.pose).axis);
      hand.Turn(axis, kStep, false);
      const double to = glm::dot(mark, BasisOf(hand.pose).axis);
      const ScopeView view = ViewFromPose(hand.pose, alpha());
      Turns turns;
      turns.Add(before, view);
      before = view;
      const double nearest = std::max(std::abs(from), std::abs(to));  // cos ε
      if (nearest > std::cos(RadiansFromDegrees(30.0))) continue;
      const double cot = nearest / std::sqrt(1.0 - nearest * nearest);
      const double most = std::max(1.0, std::cos(alpha()) + std::sin(alpha()) * cot);
      EXPECT_LE(turns.view, most * kStep + kRounding) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, ViewContinuity, testing::Values(0.0, 30.0, 70.0, 90.0));

}  // namespace
}  // namespace arthro::simulation
