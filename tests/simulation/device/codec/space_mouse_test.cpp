#include "simulation/device/codec/space_mouse.h"

#include <vector>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

using enum SpaceMouseNews;

TEST(SpaceMouse, ReadsPushAndTurnFromTwoReports) {
  SpaceMouse mouse;
  EXPECT_EQ(TakeReport(std::vector<std::uint8_t>{1, 0x5e, 0x01, 0xa2, 0xfe, 0, 0}, mouse), kTaken);
  EXPECT_EQ(mouse.push, glm::dvec3(1, -1, 0));
  EXPECT_EQ(mouse.turn, glm::dvec3(0.0));
  EXPECT_EQ(TakeReport(std::vector<std::uint8_t>{2, 0, 0, 0xaf, 0, 0, 0}, mouse), kTaken);
  EXPECT_EQ(mouse.turn, glm::dvec3(0, 0.5, 0));
  EXPECT_EQ(mouse.push, glm::dvec3(1, -1, 0)) << "stays until the next report of it";
}

TEST(SpaceMouse, ReadsPushAndTurnFromOneReport) {
  SpaceMouse mouse;
  EXPECT_EQ(
      TakeReport(std::vector<std::uint8_t>{1, 0xaf, 0, 0, 0, 0, 0, 0x51, 0xff, 0, 0, 0, 0}, mouse),
      kTaken);
  EXPECT_EQ(mouse.push, glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(mouse.turn, glm::dvec3(-0.5, 0, 0));
}

TEST(SpaceMouse, ReadsButtonsAsBitsAndClampsThePush) {
  SpaceMouse mouse;
  EXPECT_EQ(TakeReport(std::vector<std::uint8_t>{3, 0x05, 0x80}, mouse), kTaken);
  EXPECT_EQ(mouse.buttons, 0x8005u);
  EXPECT_EQ(TakeReport(std::vector<std::uint8_t>{1, 0xff, 0x7f, 0x00, 0x80, 0, 0}, mouse), kTaken);
  EXPECT_EQ(mouse.push, glm::dvec3(1, -1, 0));
}

TEST(SpaceMouse, HardCase04InvalidReportsChangeNothing) {
  SpaceMouse mouse;
  mouse.push = {0.1, 0.2, 0.3};
  mouse.buttons = 2;
  const std::vector<std::vector<std::uint8_t>> wrong{{},
                                                     {1},
                                                     {1, 0, 0, 0, 0, 0},
                                                     std::vector<std::uint8_t>(8, 1),
                                                     std::vector<std::uint8_t>(15, 1),
                                                     std::vector<std::uint8_t>(64, 2),
                                                     {2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                                                     {3},
                                                     {9, 0, 0, 0, 0, 0, 0}};
  for (const auto& report : wrong) {
    EXPECT_EQ(TakeReport(report, mouse), kRejected) << report.size();
    EXPECT_EQ(mouse.push, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(mouse.buttons, 2u);
  }
  EXPECT_EQ(TakeReport(std::vector<std::uint8_t>{0x17, 80, 0}, mouse), kIgnored) << "its battery";
}

TEST(SpaceMouse, WritesTheLightAsOneByteAfterTheId) {
  EXPECT_EQ(SpaceMouseLight(true), (std::array<std::uint8_t, 2>{4, 1}));
  EXPECT_EQ(SpaceMouseLight(false), (std::array<std::uint8_t, 2>{4, 0}));
}

}  // namespace
}  // namespace arthro::simulation
