// Implicit tissue [paper, 3.4] in contact with the proxy of the servo.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/practice/session.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kBall = 0.005, kSpacing = 0.35e-3;  // m
const glm::dvec3 kCentre(0, 0, 0.04);

// A loose body, a ball of 5 mm: as a fine mesh, and as a field sampled at 0.35 mm.
LoadedScene BallScene() {
  Tissue tissue;
  tissue.name = "loose body";
  tissue.pose.position = kCentre;
  return SceneOf(test::Sphere({0, 0, 0}, kBall, 5), tissue);
}

std::shared_ptr<ImplicitTissue> MakeField(const LoadedScene& loaded) {
  return std::make_shared<ImplicitTissue>(SolidField::FromSurface(*loaded.surfaces[0], kSpacing),
                                          loaded.scene.tissues[0].pose);
}

TEST(FieldTissue, GivesTheForceOfTheSampledBall) {
  const LoadedScene loaded = BallScene();
  Hand hand(loaded);
  hand.session.SetField(0, MakeField(loaded));
  double worst = 0, worst_turn = 0;
  for (double x : {0.0, 1e-3, 2e-3, -2.5e-3})
    for (double depth : {0.2e-3, 1e-3}) {
      hand.Lead({x, 0, 0.03});
      const glm::dvec3 out = glm::normalize(glm::dvec3(x, 0.2 * x, -kBall));
      const ToolState& tool = hand.Lead(kCentre + (kBall - depth) * out);
      EXPECT_EQ(tool.contact, 1);
      const double force = glm::length(tool.tip_force);
      worst = std::max(worst, std::abs(force - kSpring * depth));
      worst_turn =
          std::max(worst_turn, std::acos(std::min(1.0, glm::dot(tool.tip_force / force, out))));
    }
  std::printf("[ field ] force %.2g N from k d at most, turned by %.2f degrees\n", worst,
              worst_turn * 180 / 3.14159265);
  // The surface of the field differs from the ball by the sagitta of its trilinear cells, h²/8R = 3
  // µm in each of two directions, and the mesh that it is sampled from by 1 µm more.
  EXPECT_LT(worst, kSpring * (kSkin + 2 * kSpacing * kSpacing / (8 * kBall) + 1e-6));
  // The proxy rests within the friction cone, 0.03 rad, of the foot.
  EXPECT_LT(worst_turn, 0.03 + kSpacing / kBall / 4);
}

TEST(FieldTissue, AToolThatAppearsBehindAThinFlapIsHeldInFrontOfIt) {
  // A flap of 1 mm. (Around a ball the proxy would slide: beyond the centre, its near side is no
  // minimum.)
  LoadedScene loaded = BallScene();
  loaded.surfaces[0] = Share(test::Box({-5e-3, -5e-3, -5e-4}, {5e-3, 5e-3, 5e-4}));
  Hand hand(loaded);
  hand.session.SetField(0, MakeField(loaded));
  hand.instrument.Set({0, 0, 0, 0.06});  // it enters through its portal, 60 mm in a tick
  const ToolState& tool = hand.Tick();
  EXPECT_EQ(tool.fault, Fault::kNone);
  EXPECT_NEAR(tool.proxy_in_portal.z, kCentre.z - 5e-4, 1e-5);
  EXPECT_EQ(tool.contact, 1);
}

TEST(FieldTissue, RemovedTissueGivesNoForce) {
  const LoadedScene loaded = BallScene();
  Hand hand(loaded);
  const auto whole = MakeField(loaded);
  hand.session.SetField(0, whole);
  const glm::dvec3 face = kCentre - glm::dvec3(0, 0, kBall);
  EXPECT_NEAR(hand.Lead(face + glm::dvec3(0, 0, 1e-3)).penetration, 1e-3, 1e-5);
  hand.Lead({0, 0, 0.03});
  auto bitten = std::make_shared<ImplicitTissue>(*whole);
  constexpr double kBite = 2e-3;
  const FieldEdit edit = bitten->Subtract(face, kBite + 2 * kSpacing, [&](const glm::dvec3& x) {
    return glm::distance(x, face) - kBite;
  });
  EXPECT_GT(edit.removed, 0.0);
  const SkinUpdate update = bitten->UpdateSkin();
  EXPECT_LT(update.bricks_redone, update.bricks_with_skin) << "only where it changed";
  hand.session.SetField(0, bitten);
  EXPECT_EQ(hand.Lead(face + glm::dvec3(0, 0, 1e-3)).contact, kNoContact);
  const ToolState& tool = hand.Lead(face + glm::dvec3(0, 0, 2.5e-3));
  // Floor of the bite, to the resolution of cut faces: a tenth of the spacing for a sphere of 2 mm.
  EXPECT_NEAR(tool.penetration, 0.5e-3, 0.1 * kSpacing);
  hand.Lead({0, 0, 0.03});
  hand.session.SetField(0, nullptr);
  EXPECT_NEAR(hand.Lead(face + glm::dvec3(0, 0, 1e-3)).penetration, 1e-3, 1e-5) << "its mesh again";
}

TEST(FieldTissue, IsSampledFromTheSurfaceOfAnImplicitTissue) {
  LoadedScene loaded = BallScene();
  loaded.scene.tissues[0].pose.scale = 0.5;
  Hand given(loaded);
  auto field = SolidField::FromSurface(*loaded.surfaces[0], kSpacing / 0.5);
  given.session.SetField(
      0, std::make_shared<ImplicitTissue>(std::move(field), loaded.scene.tissues[0].pose));
  loaded.scene.tissues[0].is_implicit = true;
  Hand said(loaded);
  const glm::dvec3 deep = kCentre + glm::dvec3(3e-4, 2e-4, -0.5 * kBall + 5e-4);
  EXPECT_EQ(said.Lead(deep).tip_force, given.Lead(deep).tip_force);
  const double ball = 0.5 * kBall, depth = ball - glm::distance(deep, kCentre);
  EXPECT_NEAR(glm::length(said.session.snapshot().instrument.tip_force), kSpring * depth,
              kSpring * (kSkin + 2 * kSpacing * kSpacing / (8 * ball) + 1e-6));
  SurfaceMesh open = *loaded.surfaces[0];
  open.triangles.pop_back();
  loaded.surfaces[0] = Share(std::move(open));
  EXPECT_THROW(Hand{loaded}, Error) << "an open surface has no inside";
}

TEST(FieldTissue, AServoTickInContactAllocatesNothing) {
  const LoadedScene loaded = BallScene();
  Hand hand(loaded);
  hand.session.SetField(0, MakeField(loaded));
  hand.Lead({0, 0, 0.0355});
  const long before = test::Allocations();
  for (int i = 0; i < 1000; ++i) {
    hand.instrument.Set({0.05 * std::sin(0.01 * i), 0.05 * std::cos(0.01 * i), 0, 0.0365});
    hand.Tick();
  }
  EXPECT_EQ(test::Allocations(), before);
}

// The same ball as a deformable implicit tissue of the scene.
LoadedScene MakeImplicit() {
  LoadedScene loaded = BallScene();
  loaded.scene.tissues[0].is_implicit = true;
  return loaded;
}

// Places the rod 5.6 mm from the centre of the ball: the window of the shaver faces the ball, and
// 0.6 mm of it is between the jaws of a punch.
const glm::dvec3 kBeside = 0.043 * glm::dvec3(0, std::sin(0.1405), std::cos(0.1405));

double Shave(Hand& hand, int ticks) {
  hand.session.SetInstrument(ToolKind::kShaver);
  hand.Lead(kBeside);
  hand.instrument.SetButtons(1);
  hand.Tick(ticks);
  hand.instrument.SetButtons(0);
  hand.Tick(20);
  return hand.session.tissues()->bodies[0].cut.removed;
}

TEST(FieldTissue, AShaverAndAPunchRemoveTissueInASession) {
  Hand hand(MakeImplicit());
  hand.session.Enliven({}, TissuePace::kInline);
  ASSERT_NE(hand.session.tissues(), nullptr);
  ASSERT_EQ(hand.session.tissues()->bodies.size(), 1u);
  EXPECT_EQ(hand.session.tissues()->bodies[0].tissue, 0);
  const double shaved = Shave(hand, 1000);
  EXPECT_GT(shaved, 1e-9);
  EXPECT_LT(shaved, 1.1 * BodyOptions{}.shaver.rate);
  hand.Lead({0, 0, 0.02});
  hand.session.SetInstrument(ToolKind::kPunch);
  hand.Tick(200);
  hand.Lead(glm::dvec3(kBeside.y, 0, kBeside.z));
  hand.instrument.SetButtons(1);
  hand.Tick(300);
  hand.instrument.SetButtons(0);
  hand.Tick(300);
  const CutReport cut = hand.session.tissues()->bodies[0].cut;
  EXPECT_GT(cut.removed, shaved + 0.2e-9);
  std::printf("[ field ] shaved %.2f mm3, bitten %.2f mm3\n", 1e9 * shaved,
              1e9 * (cut.removed - shaved));
  // The groove of the bite, 0.6 mm deep, gives no force at the former depth of the ball.
  hand.Lead({0, 0, 0.02});
  hand.session.SetInstrument(ToolKind::kProbe);
  const glm::dvec3 in_groove = kCentre + glm::dvec3(4.7e-3, 0, -0.5e-3);
  EXPECT_EQ(hand.Lead(in_groove).contact, kNoContact);
  hand.Lead({0, 0, 0.02});
  hand.session.ResetTissues();
  EXPECT_EQ(hand.Lead(in_groove).contact, 1) << "whole again";
  EXPECT_EQ(hand.session.tissues()->bodies[0].cut.removed, 0.0);
}

// Per tick the proxy moves by two pixels more than its tip (haptics/proxy.h), and the foot of its
// planes may differ from it by a fifth of a pixel (haptics/contact.cpp).
constexpr double kPixel = 0.08 / 500;
constexpr double kStep = kSpring * 2.2 * kPixel;

TEST(FieldTissue, RemovingOrRestoringTissueAtATipGivesNoForceJump) {
  const LoadedScene loaded = MakeImplicit();
  Hand hand(loaded);
  const glm::dvec3 face = kCentre - glm::dvec3(0, 0, kBall);
  glm::dvec3 last = hand.Lead(face + glm::dvec3(0, 0, 1e-3)).tip_force;
  ASSERT_NEAR(glm::length(last), kSpring * 1e-3, kSpring * 1e-5);
  double largest = 0;
  const auto watch = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const glm::dvec3 force = hand.Tick().tip_force;
      largest = std::max(largest, glm::distance(force, last));
      last = force;
    }
  };
  auto bitten = MakeField(loaded);
  bitten->Subtract(face, 3e-3, [&](const glm::dvec3& x) { return glm::distance(x, face) - 2e-3; });
  hand.session.SetField(0, bitten);
  watch(200);
  EXPECT_EQ(last, glm::dvec3(0.0)) << "there is nothing left under the tip";
  hand.session.SetField(0, MakeField(loaded));
  // A tip that rests inside restored tissue stays there; a moving one is pushed out.
  for (int i = 0; i < 100; ++i) {
    hand.instrument.Advance({0, 0, 0, 1e-6});
    watch(1);
  }
  EXPECT_NEAR(glm::length(last), kSpring * 1.1e-3, kSpring * 1e-5);
  std::printf("[ field ] largest step of force at an edit %.3f N, 2.2 pixels are %.3f N\n", largest,
              kStep);
  EXPECT_LE(largest, kStep + (kSpring + 1e3) * 1e-6) << "the hand's own step, and its viscosity";
}

TEST(FieldTissue, CutsAreReproducibleAndATickOnThemAllocatesNothing) {
  std::array<std::vector<glm::dvec3>, 2> forces;
  std::array<std::vector<glm::dvec3>, 2> shapes;
  for (std::size_t run = 0; run < 2; ++run) {
    Hand hand(MakeImplicit());
    hand.session.Enliven({}, TissuePace::kInline);
    EXPECT_GT(Shave(hand, 500), 0.0);
    shapes[run] = hand.session.tissues()->bodies[0].positions;
    const glm::dvec3 face = kCentre - glm::dvec3(0, -0.8 * kBall, 0.6 * kBall);
    hand.Lead(0.99 * face);
    const long before = test::Allocations();
    for (int i = 0; i < 300; ++i) {
      hand.t += kTick;
      hand.instrument.Advance({1e-5 * i, 0, 0, 1e-6});
      hand.session.Tick(hand.scope.Sample(hand.t), hand.instrument.Sample(hand.t), kTick);
    }
    EXPECT_EQ(test::Allocations(), before);
    for (int i = 0; i < 300; ++i) forces[run].push_back(hand.Tick().tip_force);
  }
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(shapes[0], shapes[1]);
}

}  // namespace
}  // namespace arthro::simulation
