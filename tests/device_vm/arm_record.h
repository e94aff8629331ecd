// Record of a virtual arm, one per event, in the order of time. Its file is an array of records.
// Times in ns of the machine's clock (CLOCK_MONOTONIC); counts; mA.
#pragma once

#include <array>
#include <cstdint>

namespace arthro::test {

enum class ArmEvent : std::int32_t {
  kPlugged,    // the system took it
  kUnplugged,  // about to be
  kSent,       // an input report, with `counter`
  kFrozen,     // it stopped its parent …
  kThawed,     // … and let it go on
  kTold,       // an output report, with `size`, `currents` and `command`
};

struct ArmRecord {
  std::int64_t t_ns = 0;
  ArmEvent event = ArmEvent::kSent;
  std::int32_t counter = 0;  // base encoder
  std::int32_t size = 0;     // bytes of the output report, its number included
  std::array<std::int16_t, 3> currents{};
  std::int16_t command = 0;
};

}  // namespace arthro::test
