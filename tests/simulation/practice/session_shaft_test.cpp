// Instrument of a session whose shaft would pass through the relief (HAP-28).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/practice/shaft_notice.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/build_paths.h"

namespace arthro::simulation {
namespace {

LoadedScene Demo() {
  LoadedScene demo = LoadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/demo");
  demo.scene.tissues.clear();
  demo.surfaces.clear();
  return demo;
}

// Deepest point of the drawn shaft in the relief, without the part beside its tip.
double DeepestOfShaft(const DepthField& field, const glm::dvec3& portal, const glm::dvec3& tip) {
  const double length = glm::distance(portal, tip);
  double deepest = 0;
  for (double along = 0; along < length - 3e-3; along += 1e-4) {
    const FieldQuery query = field.Query(portal + along / length * (tip - portal));
    if (query.weight > 0) deepest = std::max(deepest, -query.clearance);
  }
  return deepest;
}

TEST(SessionShaft, InstrumentIsDrawnWithItsShaftOutOfTheRelief) {
  const LoadedScene demo = Demo();
  const DepthField field(demo.scene.backdrop, *demo.depth);
  const glm::dvec3 portal(demo.scene.portals.incision_spacing, 0, 0);
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Hand hand(demo);
  int held = 0, through = 0;
  double deepest = 0, most_force = 0;
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 tip = glm::normalize(glm::dvec3(uniform(-0.8, 0.8), uniform(-0.8, 0.8), 1)) *
                           uniform(0.02, 0.052);
    const ToolState& tool = hand.Lead(tip, 60, 140);
    if (tool.shaft_through > 0) {
      ++through;
      continue;
    }
    if (tool.shaft_held > 1e-3) {
      ++held;
      most_force = std::max(most_force, glm::length(tool.tip_force));
      EXPECT_GT(glm::length(tool.tip_force), 0.1) << i << ": 1 mm at 500 N/m, and half of it";
    }
    deepest = std::max(deepest, DeepestOfShaft(field, portal, tool.proxy_in_portal));
  }
  std::printf("%d of 100 shafts held, %d pass through; deepest %.3f mm, largest force %.1f N\n",
              held, through, 1e3 * deepest, most_force);
  EXPECT_GT(held, 5) << "the tips of this test do not lie behind a ridge";
  EXPECT_LT(through, held);
  // Grazing depth of shaft_hold.h, and a turn that is still under way while the hand holds.
  EXPECT_LT(deepest, 2e-4);
}

TEST(SessionShaft, ToolAndForceFollowWithoutAJump) {
  const LoadedScene demo = Demo();
  Hand hand(demo);
  hand.Lead({0.004, -0.01, 0.03}, 100, 100);
  glm::dvec3 last = hand.session.snapshot().instrument.proxy_in_portal, force(0);
  const RodPose from = hand.instrument.pose();
  double most = 0, most_force = 0, held = 0;
  // A sweep of 40 degrees in 2 s past the condyle, and back.
  for (int i = 0; i <= 4000; ++i) {
    const double way = i <= 2000 ? i / 2000.0 : (4000 - i) / 2000.0;
    hand.instrument.Set({from.latitude, from.longitude - 0.7 * way, 0, 0.046});
    const ToolState& tool = hand.Tick();
    if (i > 10) {
      most = std::max(most, glm::distance(tool.proxy_in_portal, last));
      most_force = std::max(most_force, glm::distance(tool.tip_force, force));
    }
    last = tool.proxy_in_portal;
    force = tool.tip_force;
    held = std::max(held, tool.shaft_held);
  }
  std::printf("held by %.1f mm; largest step %.3f mm, %.2f N\n", 1e3 * held, 1e3 * most,
              most_force);
  EXPECT_GT(held, 1e-3) << "the sweep of this test does not pass the condyle";
  // Proxy and turn each move by the motion of the tip, 0.016 mm, and two pixels of 0.05 mm.
  const double step =
      2 * (0.7 * 0.046 / 2000 + 2 * DepthField(demo.scene.backdrop, *demo.depth).pixel_size());
  EXPECT_LT(most, step);
  EXPECT_LT(most_force, kSpring * 2 * step);
}

TEST(ShaftNotice, SaysOneSentenceWhereBoneIsInTheWay) {
  ToolState tool;
  EXPECT_STREQ(ShaftNotice(tool), "");
  tool.shaft_held = 5e-4;
  EXPECT_STREQ(ShaftNotice(tool), "");
  tool.shaft_held = 3e-3;
  const std::string held = ShaftNotice(tool);
  EXPECT_NE(held.find("Bone holds the shaft"), std::string::npos);
  tool.shaft_through = 3e-3;
  const std::string through = ShaftNotice(tool);
  EXPECT_NE(through.find("passes through bone"), std::string::npos);
  for (const std::string& sentence : {held, through}) EXPECT_EQ(sentence.back(), '.');
}

}  // namespace
}  // namespace arthro::simulation
