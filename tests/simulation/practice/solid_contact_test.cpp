// Contact of the servo with solids given by functions [paper, 3.4].
#include <cmath>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/practice/living_tissues.h"
#include "simulation/scene/solids/solid_io.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

constexpr double kBallRadius = 0.005;  // m
const glm::dvec3 kSolidCentre(0, 0, 0.04);

class SolidContact : public testing::Test {
 protected:
  LoadedScene MakeScene(const Solid& solid, double scale = 1) {
    Tissue tissue;
    tissue.name = "solid";
    tissue.surface = "s.solid";
    tissue.is_implicit = true;
    tissue.pose.position = kSolidCentre;
    tissue.pose.scale = scale;
    WriteSolid(folder / "s.solid", solid);
    LoadedScene loaded = SceneOf(SurfaceOfSolid(solid), tissue);
    loaded.files["s.solid"].file = folder / "s.solid";
    return loaded;
  }
  static Solid Ball(double radius) { return {{EllipsoidPart{{}, glm::dvec3(radius)}}}; }
  test::TempFolder folder;
};

TEST_F(SolidContact, ForceIsThatOfTheClosedForm) {
  // Twice as large by the pose of the tissue.
  Hand hand(MakeScene(Ball(0.5 * kBallRadius), 2.0));
  for (const double x : {0.0, 1e-3, -2.5e-3})
    for (const double depth : {0.2e-3, 1e-3}) {
      hand.Lead({x, 0, 0.03});
      const glm::dvec3 out = glm::normalize(glm::dvec3(x, 0.2 * x, -kBallRadius));
      const ToolState& tool = hand.Lead(kSolidCentre + (kBallRadius - depth) * out);
      EXPECT_EQ(tool.contact, 1);
      // The proxy keeps kSkin; no sampling adds to it.
      EXPECT_NEAR(glm::length(tool.tip_force), kSpring * depth, kSpring * kSkin);
      // The force lies within the friction cone about the normal at the proxy, which stands
      // beside the radius through the tip: sine rule in the triangle of centre, tip and proxy.
      const double turn = 0.03 * (1 + depth / (kBallRadius - depth));
      EXPECT_GT(glm::dot(glm::normalize(tool.tip_force), out), std::cos(turn)) << "friction cone";
    }
}

TEST_F(SolidContact, NeitherToolEntersASolid) {
  const Solid ring{{TorusPart{{}, 4e-3, 1e-3}}};
  Hand hand(MakeScene(ring));
  const SolidFunction function(ring);
  hand.Lead({4e-3, 0, 0.03});
  hand.Lead({4e-3, 0, 0.04});
  EXPECT_GE(function.Value(hand.session.snapshot().instrument.proxy_in_portal - kSolidCentre), 0);
  hand.instrument.Set({0, 0, 0, 0.01});
  hand.scope.Set({0, std::atan2(4e-3, 0.0391), 0, 0.03});
  hand.Tick(300);
  hand.scope.Set({0, std::atan2(4e-3, 0.0391), 0, 0.0393});
  hand.Tick(300);
  const ToolState& scope = hand.session.snapshot().scope;
  EXPECT_EQ(scope.contact, 1);
  EXPECT_GE(function.Value(scope.proxy_in_portal - kSolidCentre), 0) << "where its camera stands";
}

TEST_F(SolidContact, AToolPassesThroughTheHoleOfARing) {
  Hand hand(MakeScene({{TorusPart{{}, 4e-3, 1e-3}}}));
  hand.Lead({0, 0, 0.03});
  EXPECT_EQ(hand.Lead({0, 0, 0.05}).contact, kNoContact);
}

TEST_F(SolidContact, AServoTickAllocatesNothing) {
  SolidPlace blended;
  blended.join = SolidJoin::kDifference;
  blended.blend = 1e-3;
  blended.solid_from_part.translation = {0, 0, -kBallRadius};
  Hand hand(MakeScene(
      {{EllipsoidPart{{}, {kBallRadius, 4e-3, kBallRadius}}, CapsulePart{blended, 2e-3, 1e-3}}}));
  hand.Lead({0, 0, 0.0355});
  const long before = test::Allocations();
  for (int i = 0; i < 1000; ++i) {
    hand.instrument.Set({0.05 * std::sin(0.01 * i), 0.05 * std::cos(0.01 * i), 0, 0.0365});
    hand.Tick();
  }
  EXPECT_EQ(test::Allocations(), before);
}

TEST_F(SolidContact, AShaverRemovesOfItAndRestoringBringsTheFunctionBack) {
  Hand hand(MakeScene(Ball(kBallRadius)));
  hand.session.Enliven({}, TissuePace::kInline);
  ASSERT_NE(hand.session.tissues(), nullptr);
  const glm::dvec3 above = kSolidCentre - glm::dvec3(0, 0, kBallRadius + 5e-3);
  const glm::dvec3 deep = kSolidCentre - glm::dvec3(0, 0, kBallRadius - 1e-3);
  const auto force = [&] {
    hand.Lead(above);
    return glm::length(hand.Lead(deep).tip_force);
  };
  const double whole = force();
  EXPECT_NEAR(whole, kSpring * 1e-3, kSpring * kSkin);
  hand.Lead(above);
  hand.session.SetInstrument(ToolKind::kPunch);
  hand.Tick(200);
  hand.Lead(0.043 * glm::dvec3(std::sin(0.1405), 0, std::cos(0.1405)));
  hand.instrument.SetButtons(1);
  hand.Tick(400);
  hand.instrument.SetButtons(0);
  hand.Tick(20);
  EXPECT_GT(hand.session.tissues()->bodies[0].cut.removed, 0);
  hand.session.SetInstrument(ToolKind::kProbe);
  hand.session.ResetTissues();
  hand.Tick(20);
  hand.Lead(above);
  EXPECT_NEAR(force(), whole, kSpring * 1e-9) << "the function again, not its samples";
}

TEST_F(SolidContact, AFileThatIsGoneIsNamed) {
  const LoadedScene loaded = MakeScene(Ball(kBallRadius));
  std::filesystem::remove(folder / "s.solid");
  try {
    Hand hand(loaded);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("s.solid"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace arthro::simulation
