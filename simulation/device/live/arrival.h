// Arrival time of the newest report of a burst. Reports wait in a ring of 63 that drops the newest
// when it is full [measured: after a stall of 300 ms the newest was 245 ms old], so a report that
// is read now need not be new: `count` reports cover at most `count` periods since the ring was
// last empty. s.
#pragma once

#include <algorithm>

namespace arthro::simulation {

// Slack: a board that answers a slower servo may report as late as its next tick.
inline constexpr double kArrivalSlack = 0.003;  // s

constexpr double ArrivalOf(double empty_at, double now, int count, double period) noexcept {
  return std::min(now, empty_at + count * period + kArrivalSlack);
}

}  // namespace arthro::simulation
