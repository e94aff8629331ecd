// Memory that a trial shares with the program it disturbs: a file that both map. The program maps
// it through fault_preload.cpp, so that what it wrote to its device outlives it. Times in ns of
// CLOCK_MONOTONIC; currents in mA, as a WoodenHaptics arm receives them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace arthro::test {

constexpr const char* kFaultPageVariable = "ARTHRO_FAULT_PAGE";  // environment: path of the file

struct ArmWrite {
  std::int64_t t = 0;
  std::array<std::int16_t, 3> current{};
  std::int16_t command = 0;  // 0: currents, 1: the counters are set
};

constexpr std::uint32_t kArmWrites = 1 << 16;  // the newest ones are kept

struct FaultPage {
  std::atomic<std::int64_t> wall_clock_offset{0};  // added to CLOCK_REALTIME, ns
  std::atomic<int> has_arm{0};                     // asked once, when the program starts
  std::atomic<int> is_arm_pulled{0};
  std::atomic<int> is_hand_moving{0};
  std::atomic<std::uint32_t> seed{1};    // start of the hand's motion
  std::atomic<std::uint32_t> writes{0};  // count; the write i lies at i % kArmWrites
  std::array<ArmWrite, kArmWrites> write;
};

}  // namespace arthro::test
