#include "simulation/tissue/field/implicit_tissue.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

SolidField BallField(double radius, double spacing) {
  return SolidField::FromFunction({glm::dvec3(-radius - kMm), glm::dvec3(radius + kMm)}, spacing,
                                  [=](const glm::dvec3& x) { return glm::length(x) - radius; });
}
double TorusDistance(const glm::dvec3& x) {
  return std::hypot(std::hypot(x.x, x.y) - 5 * kMm, x.z) - 2 * kMm;
}
SolidField TorusField(double spacing) {
  return SolidField::FromFunction({glm::dvec3(-8 * kMm), glm::dvec3(8 * kMm)}, spacing,
                                  TorusDistance);
}
Pose Somewhere() {
  Pose pose;
  pose.position = {0.01, -0.02, 0.05};
  pose.quaternion = glm::normalize(glm::dquat(0.8, 0.2, -0.4, 0.3));
  pose.scale = 1.3;
  return pose;
}

glm::dvec3 AnyDirection(std::mt19937& random) {
  std::normal_distribution<double> any;
  return glm::normalize(glm::dvec3(any(random), any(random), any(random)));
}

// The force is along the normal at the contact; compares position and direction with the analytic
// shape.
TEST(ImplicitTissue, ProbeStopsAtTheAnalyticSphereWithItsNormal) {
  const double radius = 4 * kMm, probe = 0.5 * kMm, scale = Somewhere().scale;
  for (const double h : {0.5 * kMm, 0.25 * kMm}) {
    const ImplicitTissue tissue(BallField(radius, h), Somewhere());
    std::mt19937 random(1);
    double worst_place = 0, worst_angle = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const glm::dvec3 centre = Somewhere().position;
      const glm::dvec3 from = centre + 0.015 * AnyDirection(random);
      const glm::dvec3 to = centre + 0.001 * AnyDirection(random);
      FieldHit hit;
      ASSERT_TRUE(tissue.Sweep(from, to, probe, hit));
      const glm::dvec3 at = from + hit.fraction * (to - from);
      worst_place =
          std::max(worst_place, std::abs(glm::length(at - centre) - probe - scale * radius));
      worst_angle = std::max(
          worst_angle, std::acos(std::min(1.0, glm::dot(hit.normal, glm::normalize(at - centre)))));
    }
    std::printf("ball 5.2 mm, spacing %.3f mm: position error %.1f um, direction error %.3f deg\n",
                scale * h / kMm, 1e6 * worst_place, worst_angle * 180 / std::numbers::pi);
    // Interpolation error: h²/8 of the sum of curvatures. Direction error: differences over h have
    // the third derivative's error, about (h/R)²/8, and its change within a cell, about the same.
    EXPECT_LT(worst_place, scale * h * h / 8 * 2 / radius * 1.2);
    EXPECT_LT(worst_angle, 0.5 * (h / radius) * (h / radius));
  }
}

TEST(ImplicitTissue, NormalOnATorusAgreesWithTheAnalyticNormal) {
  for (const double h : {0.5 * kMm, 0.25 * kMm}) {
    const ImplicitTissue tissue(TorusField(h), {});
    std::mt19937 random(2);
    double worst_place = 0, worst_angle = 0;
    int hits = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const glm::dvec3 from = 12 * kMm * AnyDirection(random);
      const glm::dvec3 to = -0.8 * from + 3 * kMm * AnyDirection(random);
      FieldHit hit;
      if (!tissue.Sweep(from, to, 0.0, hit)) continue;
      ++hits;
      const glm::dvec3 at = from + hit.fraction * (to - from);
      worst_place = std::max(worst_place, std::abs(TorusDistance(at)));
      const double ring = std::hypot(at.x, at.y);
      const glm::dvec3 core = 5 * kMm * glm::dvec3(at.x / ring, at.y / ring, 0);
      worst_angle = std::max(
          worst_angle, std::acos(std::min(1.0, glm::dot(hit.normal, glm::normalize(at - core)))));
    }
    EXPECT_GT(hits, 150);
    std::printf("torus 5/2 mm, spacing %.2f mm: position error %.1f um, direction error %.3f deg\n",
                h / kMm, 1e6 * worst_place, worst_angle * 180 / std::numbers::pi);
    EXPECT_LT(worst_place, h * h / 8 * (1 / (2 * kMm) + 1 / (3 * kMm)) * 1.2);
    EXPECT_LT(worst_angle, 0.5 * h / (2 * kMm) * h / (2 * kMm));
  }
}

TEST(ImplicitTissue, SweepDoesNotTunnelThroughAThinDisc) {
  // A disc as thin as the grid permits: 1.5 spacings.
  const double h = 0.3 * kMm;
  const ImplicitTissue disc(SolidField::FromFunction({glm::dvec3(-6 * kMm), glm::dvec3(6 * kMm)}, h,
                                                     [&](const glm::dvec3& x) {
                                                       return std::max(
                                                           std::abs(x.z) - 0.75 * h,
                                                           std::hypot(x.x, x.y) - 5 * kMm);
                                                     }),
                            {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3 * kMm, 3 * kMm), far(0.001, 0.5);
  for (int trial = 0; trial < 500; ++trial) {
    const glm::dvec3 through(any(random), any(random), 0);
    glm::dvec3 way = AnyDirection(random);
    if (std::abs(way.z) < 0.2) way.z = 0.2;
    FieldHit hit;
    ASSERT_TRUE(disc.Sweep(through - far(random) * way, through + far(random) * way, 0.0, hit));
    EXPECT_LT(glm::dot(hit.normal, way), 0.0);
  }
}

TEST(ImplicitTissue, SweepIgnoresSeparatingMotionAndLaterHits) {
  const ImplicitTissue ball(BallField(4 * kMm, 0.25 * kMm), {});
  FieldHit hit;
  EXPECT_FALSE(ball.Sweep({0, 0, 3.8 * kMm}, {0, 0, 10 * kMm}, 0.5 * kMm, hit));
  ASSERT_TRUE(ball.Sweep({0, 0, 4 * kMm}, {0, 0, 2 * kMm}, 0.5 * kMm, hit));
  EXPECT_EQ(hit.fraction, 0.0);
  EXPECT_NEAR(hit.gap, -0.5 * kMm, 0.01 * kMm);
  hit = {};
  hit.fraction = 0.1;
  EXPECT_FALSE(ball.Sweep({0, 0, 10 * kMm}, {0, 0, 0}, 0.5 * kMm, hit));
  EXPECT_EQ(hit.fraction, 0.1);
  const glm::dvec3 nowhere(std::nan(""));
  EXPECT_FALSE(ball.Sweep(nowhere, {0, 0, 0}, 0.5 * kMm, hit));
}

TEST(ImplicitTissue, SweepsAllocateNothing) {
  const ImplicitTissue ball(BallField(4 * kMm, 0.25 * kMm), Somewhere());
  const long before = test::Allocations();
  for (int i = 0; i < 100; ++i) {
    FieldHit hit;
    ball.Sweep({0.03, 0.001 * i, 0.05}, {0, -0.02, 0.05}, 0.5 * kMm, hit);
  }
  EXPECT_EQ(test::Allocations(), before);
}

TEST(ImplicitTissue, EditsInThePortalFrameChangeFieldAndSkinThere) {
  ImplicitTissue tissue(BallField(4 * kMm, 0.25 * kMm), Somewhere());
  const Pose pose = Somewhere();
  const glm::dvec3 bite = pose * glm::dvec3(4 * kMm, 0, 0);
  const auto to_bite = [&](const glm::dvec3& x) { return glm::length(x - bite) - 1.3 * kMm; };
  const FieldEdit taken = tissue.Subtract(bite, 2.5 * kMm, to_bite);
  EXPECT_GT(taken.removed, 0.0);
  const SkinUpdate update = tissue.UpdateSkin();
  EXPECT_GT(update.bricks_redone, 0);
  EXPECT_LT(update.bricks_redone, update.bricks_with_skin / 3);
  EXPECT_GT(tissue.Distance(pose * glm::dvec3(3.5 * kMm, 0, 0)), 0.0);
  // A ball from the bite's side now moves further by the bite's radius.
  FieldHit hit;
  const glm::dvec3 from = pose * glm::dvec3(9 * kMm, 0, 0), to = pose.position;
  ASSERT_TRUE(tissue.Sweep(from, to, 0.0, hit));
  EXPECT_NEAR(glm::length(from + hit.fraction * (to - from) - to), 1.3 * (4 - 1) * kMm, 0.02 * kMm);
  // After filling, contact is at the original position.
  tissue.Add(bite, 2.5 * kMm,
             [&](const glm::dvec3& x) { return glm::length(x - pose.position) - 1.3 * 4 * kMm; });
  hit = {};
  ASSERT_TRUE(tissue.Sweep(from, to, 0.0, hit));
  EXPECT_NEAR(glm::length(from + hit.fraction * (to - from) - to), 1.3 * 4 * kMm, 0.01 * kMm);
}

}  // namespace
}  // namespace arthro::simulation
