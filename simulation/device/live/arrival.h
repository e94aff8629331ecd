// When the newest of a burst of reports came. Reports wait in a ring of 63 that drops the newest
// when it is full [measured: after a stall of 300 ms the freshest was 245 ms old], so what is read
// now need not be of now: `count` reports explain no more than `count` periods since the ring was
// last seen empty. s.
#pragma once

#include <algorithm>

namespace arthro::simulation {

// A report may be as late as the next tick of a slower servo, which it answers.
inline constexpr double kArrivalSlack = 0.003;  // s

constexpr double ArrivalOf(double empty_at, double now, int count, double period) noexcept {
  return std::min(now, empty_at + count * period + kArrivalSlack);
}

}  // namespace arthro::simulation
