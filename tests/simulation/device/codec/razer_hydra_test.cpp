#include "simulation/device/codec/razer_hydra.h"

#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

// The left hand at (100, −50, 300) mm, turned by 90° about x, buttons 1 and 7, stick half right,
// trigger pulled; the right one at rest.
std::vector<std::uint8_t> Golden() {
  std::vector<std::uint8_t> report(52, 0);
  const auto put = [&](std::size_t at, int value) {
    report[at] = static_cast<std::uint8_t>(value & 0xff);
    report[at + 1] = static_cast<std::uint8_t>(value >> 8 & 0xff);
  };
  put(8, 100), put(10, -50), put(12, 300);
  put(14, 23170), put(16, 23170), put(18, 0), put(20, 0);
  report[22] = 0xc1;
  put(23, 16384), put(25, 0);
  report[27] = 255;
  put(36, 32767);
  return report;
}

TEST(RazerHydra, ReadsBothHands) {
  const auto hands = ParseHydra(Golden());
  ASSERT_TRUE(hands);
  const HydraHand& left = hands->at(0);
  EXPECT_LT(glm::distance(left.position, glm::dvec3(0.1, -0.05, 0.3)), 1e-15);
  EXPECT_LT(glm::distance(left.orientation * glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)), 1e-12);
  EXPECT_NEAR(glm::length(left.orientation), 1, 1e-15);
  EXPECT_EQ(left.buttons, 0x41) << "the eighth bit is not a button";
  EXPECT_NEAR(left.stick.x, 0.5, 1e-4);
  EXPECT_EQ(left.trigger, 1.0);
  EXPECT_EQ(hands->at(1).orientation, glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(hands->at(1).trigger, 0.0);
}

TEST(RazerHydra, HardCase04RejectsInvalidReports) {
  for (const std::size_t length : {0, 1, 13, 15, 49, 65}) {
    std::vector<std::uint8_t> report = Golden();
    report.resize(length);
    EXPECT_FALSE(ParseHydra(report)) << length;
  }
  std::vector<std::uint8_t> report = Golden();
  report[15] = 0x10;
  EXPECT_FALSE(ParseHydra(report)) << "a quaternion of another length";
  EXPECT_FALSE(ParseHydra(std::vector<std::uint8_t>(52, 0))) << "nor one of none";
}

TEST(RazerHydra, IsStartedAndStopped) {
  const auto on = HydraMotionReport(true), off = HydraMotionReport(false);
  EXPECT_EQ(on[6], 1);
  EXPECT_EQ(on[8], 4);
  EXPECT_EQ(on[9], 3);
  EXPECT_EQ(on[89], 6);
  EXPECT_EQ(off[9], 0);
  EXPECT_EQ(off[89], 5);
}

}  // namespace
}  // namespace arthro::simulation
