// Random bytes of random lengths in every codec: nothing crashes and all results are finite.
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/device/codec/razer_hydra.h"
#include "simulation/device/codec/space_mouse.h"
#include "simulation/device/codec/wooden_haptics.h"

namespace arthro::simulation {
namespace {

TEST(FuzzedReports, HardCase04NeverDecodeToNaN) {
  Random random(4);
  SpaceMouse mouse;
  EncoderUnwrap unwrap(93);
  int wooden = 0, space = 0;
  for (int i = 0; i < 200000; ++i) {
    std::vector<std::uint8_t> report(random.Below(80));
    for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random.Below(256));
    if (!report.empty() && i % 2) report[0] = static_cast<std::uint8_t>(random.Below(5));
    if (const auto parsed = ParseWooden(report)) {
      ++wooden;
      unwrap.Take(parsed->encoder);
      const WoodenArm arm;
      const glm::dvec3 angles = WoodenAngles(arm, unwrap.total());
      ASSERT_TRUE(std::isfinite(glm::length(WoodenPosition(arm, angles))));
      ASSERT_NEAR(glm::length(WoodenHandle(arm, angles, unwrap.total())), 1, 1e-9);
    }
    if (const auto hands = ParseHydra(report)) {
      for (const HydraHand& hand : *hands) ASSERT_NEAR(glm::length(hand.orientation), 1, 1e-12);
    }
    space += TakeReport(report, mouse) == SpaceMouseNews::kTaken;
    ASSERT_LE(glm::length(mouse.push), std::sqrt(3.0));
    ASSERT_LE(glm::length(mouse.turn), std::sqrt(3.0));
  }
  EXPECT_GT(wooden, 1000);
  EXPECT_GT(space, 1000);
}

}  // namespace
}  // namespace arthro::simulation
