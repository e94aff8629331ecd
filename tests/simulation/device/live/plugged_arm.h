// A WoodenHaptics arm on a fake bus, plugged in and held by a live device.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/simulation/device/live/arm_bench.h"

namespace arthro::simulation {

using test::ArmBench;
using test::Board;
using test::Bytes;
using test::CurrentsAt;
using test::WaitUntil;

inline const std::string kPath = "/dev/fake0", kOther = "/dev/fake1";
inline const glm::dvec3 kNone(0.0), kPush(0, 0, 3);
inline constexpr std::array<int, 3> kNoCurrents{};

struct Plugged : ArmBench {
  Plugged() : board(usb, kPath) { usb.Plug(test::WoodenArm(L"A", kPath)); }
  ~Plugged() {
    // The threads of the link call the board.
    device.reset();
    link.reset();
    EXPECT_EQ(usb.misuses(), 0);
    EXPECT_EQ(usb.opened(kPath), 0);
  }
  Board board;
};

inline bool AreZeros(const std::vector<Bytes>& reports) {
  for (const Bytes& report : reports)
    if (report != Bytes(15)) return false;
  return true;
}

}  // namespace arthro::simulation
