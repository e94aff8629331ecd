#include "simulation/haptics/output/lever.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

constexpr double kRod = 0.2;

// Returns tip − pivot of a rod through the pivot for any hand position.
glm::dvec3 Tip(const glm::dvec3& hand) {
  const double r = glm::length(hand);
  return (r - kRod) / r * hand;
}

// F_hand = Jᵀ F_tip: for any small motion of the hand both forces do the same work.
TEST(Lever, HandForceDoesTheWorkOfTheTipForce) {
  double worst = 0;
  for (const glm::dvec3 hand : {glm::dvec3(0.01, -0.02, -0.15), {0.05, 0.03, -0.04}, {0, 0, -0.19}})
    for (const glm::dvec3 force : {glm::dvec3(1, 0, 0), {0.3, -0.5, 0.2}, {0, 0, 2}}) {
      const glm::dvec3 at_hand = HandForce(LeverAt(hand, kRod, {}), force);
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = 1e-6;
        const glm::dvec3 moved = Tip(hand + step) - Tip(hand - step);
        const double error = glm::dot(force, moved) / 2e-6 - at_hand[axis];
        worst = std::max(worst, std::abs(error));
        EXPECT_NEAR(error, 0.0, 1e-8) << "central difference, 1 µm";
      }
    }
  std::printf("largest difference from the virtual work: %.1e N\n", worst);
}

TEST(Lever, ForceAcrossIsReversedAndScaled) {
  // L = 200 mm, r = 60 mm has gain 2.33 and the sign of a lever.
  const Lever lever = LeverAt({0, 0, -0.06}, kRod, {});
  const glm::dvec3 force = HandForce(lever, {1, 0, 3});
  EXPECT_NEAR(force.x, -7.0 / 3.0, 1e-12);
  EXPECT_NEAR(force.z, 3.0, 1e-12);
}

TEST(Lever, StiffnessAtTheHandStaysBelowTheDevices) {
  const LeverOptions options;
  for (double r = 0.006; r < 0.3; r += 0.001) {
    const Lever lever = LeverAt({0, 0, -r}, kRod, options);
    const double gain = std::max(1.0, std::abs(lever.across));
    EXPECT_LE(lever.max_stiffness * gain * gain, options.max_stiffness * (1 + 1e-12));
  }
}

// HAP-15.
TEST(Lever, IsFiniteAndFadesAtTheIncision) {
  const LeverOptions options;
  for (double r : {0.0, 1e-300, 1e-12, 1e-3, 0.005}) {
    const glm::dvec3 force = HandForce(LeverAt({r, 0, 0}, kRod, options), {1, 2, 3});
    EXPECT_EQ(force, glm::dvec3(0.0)) << r;
  }
  const glm::dvec3 at_tip = HandForce(LeverAt({0, 0, -kRod}, kRod, options), {1, 2, 3});
  EXPECT_NEAR(at_tip.x, 0.0, 1e-12) << "r = L: the tip is in the incision and has no lever";
  EXPECT_NEAR(at_tip.z, 3.0, 1e-12);
  EXPECT_EQ(LeverAt({0, 0, -options.fade_begin}, kRod, options).fade, 1.0);
}

// The hand moves through the incision: since the stiffness is lowered with the lever, the hand
// force for 1 mm of penetration neither grows nor jumps, and it is zero where its sign changes.
TEST(Lever, HandCrossingTheIncisionFeelsNoFlutter) {
  glm::dvec3 last(0.0);
  for (double x = -0.03; x < 0.03; x += 1e-4) {  // 0.1 m/s at 1 kHz
    const Lever lever = LeverAt({x, 1e-4, 0}, kRod, {});
    const double stiffness = std::min(500.0, lever.max_stiffness);
    const glm::dvec3 force = HandForce(lever, stiffness * 1e-3 * glm::dvec3(0.6, 0.8, 0));
    EXPECT_LT(glm::length(force), 0.5 * 1.01);
    if (x > -0.03) {
      EXPECT_LT(glm::length(force - last), 0.02);
    }
    last = force;
  }
}

}  // namespace
}  // namespace arthro::simulation
